// SPDX-License-Identifier: Apache-2.0
#include "sil/view/command.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace striker::sil {

namespace {

using Json = nlohmann::json;

// Reads the keys of one object, each at most once, and knows whether it asked for all of them.
class Keys {
 public:
  explicit Keys(const Json& object) : object_(&object) {}

  [[nodiscard]] std::optional<std::string> text(const char* key) {
    const Json* value = find(key);
    return value != nullptr && value->is_string() ? std::optional(value->get<std::string>()) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::uint64_t> whole(const char* key, std::uint64_t least,
                                                   std::uint64_t greatest) {
    const Json* value = find(key);
    if (value == nullptr || !value->is_number_unsigned()) {
      return std::nullopt;
    }
    const auto number = value->get<std::uint64_t>();
    return number >= least && number <= greatest ? std::optional(number) : std::nullopt;
  }
  // 0: "max".
  [[nodiscard]] std::optional<double> speed(const char* key) {
    const Json* value = find(key);
    if (value != nullptr && *value == "max") {
      return 0.0;
    }
    if (value == nullptr || !value->is_number()) {
      return std::nullopt;
    }
    const auto number = value->get<double>();
    return number >= least_view_speed && number <= greatest_view_speed ? std::optional(number) : std::nullopt;
  }
  [[nodiscard]] bool has(const char* key) const { return object_->contains(key); }
  [[nodiscard]] bool all_read() const { return read_ == object_->size(); }

 private:
  const Json* find(const char* key) {
    const auto found = object_->find(key);
    read_ += found == object_->end() ? 0 : 1;
    return found == object_->end() ? nullptr : &*found;
  }

  const Json* object_;
  std::size_t read_ = 0;
};

std::optional<ViewAction> action_of(const std::string& name) {
  constexpr std::array<std::string_view, 7> names = {"pause",   "run",  "step", "speed",
                                                     "restart", "stop", "fault"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      return static_cast<ViewAction>(i);
    }
  }
  return std::nullopt;
}

template <class Number, class Read>
bool take(Number& into, const std::optional<Read>& read) {
  into = read ? static_cast<Number>(*read) : into;
  return read.has_value();
}

bool read_robot(Keys& keys, ViewCommand& command) {
  command.robot = keys.whole("robot", 0, most_viewed_robots - 1);
  return command.robot.has_value();
}

bool read_fault(Keys& keys, ViewCommand& command) {
  const auto name = keys.text("kind");
  const auto kind = name ? fault_kind_of(*name) : std::nullopt;
  return take(command.kind, kind) && read_robot(keys, command) &&
         take(command.for_ms, keys.whole("ms", 1, 60'000));
}

bool read_rest(Keys& keys, ViewCommand& command) {
  switch (command.action) {
    case ViewAction::step:
      return !keys.has("ticks") || take(command.ticks, keys.whole("ticks", 1, 1000));
    case ViewAction::speed:
      return take(command.speed, keys.speed("x"));
    case ViewAction::restart:
      return take(command.seed, keys.whole("seed", 0, UINT64_MAX));
    case ViewAction::stop:
      return !keys.has("robot") || read_robot(keys, command);
    case ViewAction::fault:
      return read_fault(keys, command);
    case ViewAction::pause:
    case ViewAction::run:
      return true;
  }
  return false;
}

}  // namespace

std::optional<ViewCommand> parse_command(std::string_view text) {
  if (text.size() > most_command_bytes) {
    return std::nullopt;
  }
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    return std::nullopt;
  }
  Keys keys(json);
  const auto name = keys.text("do");
  const auto action = name ? action_of(*name) : std::nullopt;
  ViewCommand command;
  if (!take(command.action, action) || !read_rest(keys, command) || !keys.all_read()) {
    return std::nullopt;
  }
  return command;
}

}  // namespace striker::sil

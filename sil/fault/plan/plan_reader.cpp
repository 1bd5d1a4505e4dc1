// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <sstream>
#include <stdexcept>

#include "firmware/can/messages.hpp"
#include "firmware/host/files.hpp"
#include "sil/fault/plan/plan_file.hpp"

namespace striker::sil {

namespace {

constexpr double longest_ms = 3'600'000.0;

// One table of the file, and what is wrong with it.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string place, const std::string& file)
      : table_(&table), place_(std::move(place)), file_(&file) {}

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }

  // Of the table's keys only these may stand in it.
  void allow(std::span<const std::string_view> keys) const {
    for (const auto& [key, value] : *table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        fail(key.source().begin.line, key.str(),
             fmt::format("is no key here; it may be one of: {}", fmt::join(keys, ", ")));
      }
    }
  }

  [[nodiscard]] double number(std::string_view key, double least, double greatest) const {
    const toml::node& node = at(key);
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= least && *value <= greatest)) {
      fail(key, fmt::format("must be a number from {} to {}", least, greatest));
    }
    return *value;
  }

  [[nodiscard]] double whole(std::string_view key, double least, double greatest) const {
    const auto value = at(key).value_exact<std::int64_t>();
    if (!value || static_cast<double>(*value) < least || static_cast<double>(*value) > greatest) {
      fail(key, fmt::format("must be a whole number from {} to {}", least, greatest));
    }
    return static_cast<double>(*value);
  }

  [[nodiscard]] std::string text(std::string_view key) const {
    const auto value = at(key).value_exact<std::string>();
    if (!value || value->empty()) {
      fail(key, "must be a text");
    }
    return *value;
  }

  // The number of the text among these names.
  template <class Names>
  [[nodiscard]] std::size_t choice(std::string_view key, const Names& names) const {
    const std::string value = text(key);
    const auto found = std::find(std::begin(names), std::end(names), value);
    if (found == std::end(names)) {
      fail(key, fmt::format("must be one of: {}", fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(found - std::begin(names));
  }

  // The tables of an array, each with its reader.
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key, const std::string& name) const {
    const toml::array* const array = has(key) ? at(key).as_array() : nullptr;
    if (array == nullptr || array->empty()) {
      throw std::runtime_error(fmt::format("{}: line {}: {} needs at least one [[{}]]", *file_,
                                           table_->source().begin.line, place_.empty() ? "a plan" : place_,
                                           name));
    }
    std::vector<TableReader> readers;
    for (const toml::node& node : *array) {
      if (!node.is_table()) {
        fail(key, fmt::format("must be written as [[{}]]", name));
      }
      readers.emplace_back(*node.as_table(), name, *file_);
    }
    return readers;
  }

  [[noreturn]] void fail(std::string_view key, const std::string& rule) const {
    if (!has(key)) {
      fail(table_->source().begin.line, key, "is missing: " + rule);
    }
    std::ostringstream value;
    at(key).visit([&](const auto& node) { value << node; });
    fail(at(key).source().begin.line, key, fmt::format("= {}: {}", value.str(), rule));
  }

 private:
  [[noreturn]] void fail(unsigned line, std::string_view key, const std::string& rule) const {
    throw std::runtime_error(
        fmt::format("{}: line {}: {}{}{} {}", *file_, line, place_, place_.empty() ? "" : ".", key, rule));
  }

  [[nodiscard]] const toml::node& at(std::string_view key) const {
    static const toml::value<bool> nothing(false);
    const toml::node* const node = table_->get(key);
    return node == nullptr ? nothing : *node;
  }

  const toml::table* table_;
  std::string place_;
  const std::string* file_;
};

std::vector<std::string_view> message_names() {
  std::vector<std::string_view> names;
  can::for_each_layout([&](const auto& message) { names.push_back(message.info.name); });
  return names;
}

std::uint16_t read_message(const TableReader& reader, std::string_view key) {
  const auto names = message_names();
  return identifier_of(names[reader.choice(key, names)]).value();
}

FaultKind read_kind(const TableReader& reader) {
  std::vector<std::string_view> names;
  for (const FaultKindInfo& info : fault_kinds()) {
    names.push_back(info.name);
  }
  return static_cast<FaultKind>(reader.choice("kind", names));
}

std::vector<std::string_view> keys_of(const FaultKindInfo& info) {
  std::vector<std::string_view> keys = {"kind", "from_ms", "until_ms", "from_tick", "until_tick", "stream"};
  const auto add = [&](bool known, std::string_view key) {
    if (known) {
      keys.push_back(key);
    }
  };
  add(info.message != MessageParameter::none, "message");
  add(info.kind == FaultKind::masquerade, "as");
  add(info.wheel, "wheel");
  add(info.probability.known(), "probability");
  add(info.count.known(), "count");
  add(info.value.known(), info.value_key);
  return keys;
}

void read_window(const TableReader& reader, const FaultKindInfo& info, Fault& fault) {
  fault.absolute = reader.has("from_tick");
  const std::string_view from = fault.absolute ? "from_tick" : "from_ms";
  const std::string_view until = fault.absolute ? "until_tick" : "until_ms";
  const double least = fault.absolute ? 0.0 : -longest_ms;
  fault.from_ms = static_cast<std::int32_t>(reader.whole(from, least, longest_ms));
  if (info.at_once && !reader.has(until)) {
    fault.until_ms = fault.from_ms + 1;
    return;
  }
  fault.until_ms = static_cast<std::int32_t>(reader.whole(until, least, longest_ms));
  if (fault.until_ms <= fault.from_ms) {
    reader.fail(until, fmt::format("must be later than {}", from));
  }
}

Fault read_fault(const TableReader& reader, std::uint64_t number) {
  const FaultKindInfo& info = info_of(read_kind(reader));
  reader.allow(keys_of(info));
  Fault fault = usual(info.kind, 0, 0);
  fault.stream = number;
  read_window(reader, info, fault);
  if (info.message == MessageParameter::one ||
      (info.message == MessageParameter::any && reader.has("message") && reader.text("message") != "all")) {
    fault.message = read_message(reader, "message");
  }
  if (info.kind == FaultKind::masquerade) {
    fault.as = read_message(reader, "as");
  }
  if (reader.has("wheel")) {
    fault.wheel = static_cast<FaultyWheel>(reader.choice("wheel", faulty_wheel_names));
  }
  if (reader.has("probability")) {
    fault.probability = reader.number("probability", info.probability.least, info.probability.greatest);
  }
  if (reader.has("count")) {
    fault.count = static_cast<std::uint32_t>(reader.whole("count", info.count.least, info.count.greatest));
  }
  if (info.value.known() && reader.has(info.value_key)) {
    fault.value = reader.number(info.value_key, info.value.least, info.value.greatest);
  }
  if (reader.has("stream")) {
    fault.stream = static_cast<std::uint64_t>(reader.whole("stream", 0, 1e9));
  }
  return fault;
}

FaultSetup read_setup(const TableReader& reader) {
  constexpr std::array poses = {std::string_view("origin"), std::string_view("anywhere")};
  constexpr double greatest = 0x1p53;
  FaultSetup setup;
  if (reader.has("plant")) {
    std::array<std::string_view, plant_kinds.size()> names;
    std::transform(plant_kinds.begin(), plant_kinds.end(), names.begin(),
                   [](PlantKind kind) { return name_of(kind); });
    setup.plant = plant_kinds[reader.choice("plant", names)];
  }
  if (reader.has("pose")) {
    setup.anywhere = reader.choice("pose", poses) == 1;
  }
  if (reader.has("seed")) {
    setup.seed = static_cast<std::uint64_t>(reader.whole("seed", 0, greatest));
  }
  if (reader.has("episode")) {
    setup.episode = static_cast<std::uint64_t>(reader.whole("episode", 0, greatest));
  }
  if (reader.has("torque_scale")) {
    setup.torque_scale = reader.number("torque_scale", 0.5, 1.5);
  }
  return setup;
}

FaultCase read_case(const TableReader& reader) {
  constexpr std::array<std::string_view, 7> keys = {"name",    "plant",        "pose", "seed",
                                                    "episode", "torque_scale", "fault"};
  reader.allow(keys);
  FaultCase result{.name = reader.text("name"), .setup = read_setup(reader), .faults = {}};
  for (const TableReader& fault : reader.tables("fault", "case.fault")) {
    result.faults.push_back(read_fault(fault, result.faults.size()));
  }
  return result;
}

}  // namespace

FaultPlan read_plan(const std::filesystem::path& file) {
  return parse_plan(host::read_file(file, host::most_text_bytes), file.string());
}

FaultPlan parse_plan(std::string_view text, const std::string& file) {
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}: line {}: {}", file, error.source().begin.line, error.description()));
  }
  constexpr std::array<std::string_view, 1> keys = {"case"};
  const TableReader reader(root, "", file);
  reader.allow(keys);
  FaultPlan plan;
  for (const TableReader& one : reader.tables("case", "case")) {
    plan.cases.push_back(read_case(one));
  }
  return plan;
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <string_view>

namespace striker::sil {

namespace {

constexpr double ns_per_ms = 1e6;

// Of a message or an attribute. The library's regular expressions need stack for every letter.
constexpr std::size_t longest_line = 4096;

constexpr std::uint32_t no_message = 0xC0000000;  // Vector's home for signals that are in no message

struct Described {
  std::string name;
  std::string sender;
  std::int64_t bytes = 0;
  std::map<std::string, double> attributes;
};

struct Dbc {
  std::map<std::uint32_t, Described> messages;
  std::map<std::string, double> defaults;
};

class DbcReader {
 public:
  explicit DbcReader(const std::filesystem::path& file) : file_(file) {
    std::ifstream stream(file);
    if (!stream) {
      throw std::runtime_error(
          fmt::format("{}: cannot be read ({}): name a DBC file", file.string(), std::strerror(errno)));
    }
    for (std::string line; std::getline(stream, line); ++line_) {
      take(line);
    }
    if (dbc_.messages.empty()) {
      fail("no message (BO_) in it: name a DBC file");
    }
  }
  [[nodiscard]] const Dbc& dbc() const { return dbc_; }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
  }

  template <class Number>
  [[nodiscard]] Number number(const std::string& text) const {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail(fmt::format("line {}: '{}' is no number in range", line_, text));
    }
    return value;
  }

  void take(const std::string& line) {
    static const std::regex message(R"(\s*BO_\s+(\d+)\s+(\w+)\s*:\s*(\d+)\s+(\w+).*)");
    static const std::regex attribute(R"(\s*BA_\s+"(\w+)\"\s+BO_\s+(\d+)\s+([-+.eE\d]+)\s*;.*)");
    static const std::regex absent(R"(\s*BA_DEF_DEF_\s+"(\w+)\"\s+([-+.eE\d]+)\s*;.*)");
    const std::string_view text =
        std::string_view(line).substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!text.starts_with("BO_") && !text.starts_with("BA_")) {
      return;
    }
    if (line.size() > longest_line) {
      fail(fmt::format("line {}: longer than {} letters", line_, longest_line));
    }
    std::smatch part;
    if (std::regex_match(line, part, message)) {
      const auto id = number<std::uint32_t>(part[1]);
      const Described described{part[2], part[4], number<int>(part[3]), {}};
      if (id != no_message && !dbc_.messages.try_emplace(id, described).second) {
        fail(fmt::format("line {}: identifier {} is there twice", line_, id));
      }
    } else if (std::regex_match(line, part, attribute)) {
      const auto found = dbc_.messages.find(number<std::uint32_t>(part[2]));
      if (found != dbc_.messages.end()) {
        found->second.attributes[part[1]] = number<double>(part[3]);
      }
    } else if (std::regex_match(line, part, absent)) {
      dbc_.defaults[part[1]] = number<double>(part[2]);
    }
  }

  std::filesystem::path file_;
  Dbc dbc_;
  int line_ = 1;
};

// The message's own value, or else the file's default, or else 0.
double attribute(const Dbc& dbc, const Described& message, const char* name) {
  const auto own = message.attributes.find(name);
  if (own != message.attributes.end()) {
    return own->second;
  }
  const auto absent = dbc.defaults.find(name);
  return absent != dbc.defaults.end() ? absent->second : 0.0;
}

std::int64_t first_but_zero_ns(std::initializer_list<double> times_ms) {
  for (const double time_ms : times_ms) {
    if (time_ms != 0.0) {
      return std::llround(time_ms * ns_per_ms);
    }
  }
  return 0;
}

// What a DBC says of a message's traffic, in ms; 0: nothing.
struct Traffic {
  double period_ms = 0.0;
  double distance_ms = 0.0;
  double deadline_ms = 0.0;
  double burst = 0.0;
};

// What keeps a message out of a budget, and the way out; or nothing.
const char* problem_of(std::uint32_t id, const Described& message, const Traffic& traffic,
                       double fallback_ms) {
  if (id > 0x7FF) {
    return "an extended identifier: the budget is for 11-bit identifiers; leave the message out";
  }
  if (message.bytes > 8) {
    return "more than 8 bytes: the budget is for classic CAN; leave the message out";
  }
  if (first_but_zero_ns({traffic.period_ms, traffic.distance_ms, fallback_ms}) == 0) {
    return "neither GenMsgCycleTime nor GenMsgDelayTime: give one, or --default-distance-ms";
  }
  for (const double time_ms : {traffic.period_ms, traffic.distance_ms, traffic.deadline_ms}) {
    if (!(time_ms == 0.0 || (time_ms >= 0.001 && time_ms <= 1e7))) {
      return "times go from 0.001 to 10,000,000 ms";
    }
  }
  if (!(traffic.burst >= 0.0 && traffic.burst <= 1e3) ||
      (traffic.period_ms > 0.0 && traffic.distance_ms > traffic.period_ms)) {
    return "Burst goes from 1 to 1000, and GenMsgDelayTime up to GenMsgCycleTime";
  }
  return nullptr;
}

BusMessage bus_message(std::uint32_t id, const Described& message, const Traffic& traffic,
                       double fallback_ms) {
  const auto [period_ms, distance_ms, deadline_ms, burst] = traffic;
  const std::int64_t distance_ns = first_but_zero_ns({distance_ms, period_ms, fallback_ms});
  const std::int64_t period_ns =
      burst > 1.0 ? first_but_zero_ns({period_ms, distance_ms, fallback_ms}) : distance_ns;
  return {.name = message.name,
          .sender = message.sender,
          .id = static_cast<std::uint16_t>(id),
          .bytes = message.bytes,
          .period_ns = period_ns,
          .distance_ns = distance_ns,
          .burst = std::max<std::int64_t>(1, std::llround(burst)),
          .deadline_ns = first_but_zero_ns({deadline_ms, period_ms, distance_ms, fallback_ms})};
}

}  // namespace

std::vector<BusMessage> read_dbc(const std::filesystem::path& file, std::int64_t default_distance_ms) {
  const DbcReader reader(file);
  const auto fallback_ms = static_cast<double>(default_distance_ms);
  std::vector<BusMessage> messages;
  for (const auto& [id, message] : reader.dbc().messages) {
    if (attribute(reader.dbc(), message, "Awaited") != 0.0) {
      continue;
    }
    const Traffic traffic{.period_ms = attribute(reader.dbc(), message, "GenMsgCycleTime"),
                          .distance_ms = attribute(reader.dbc(), message, "GenMsgDelayTime"),
                          .deadline_ms = attribute(reader.dbc(), message, "Deadline"),
                          .burst = attribute(reader.dbc(), message, "Burst")};
    if (const char* problem = problem_of(id, message, traffic, fallback_ms)) {
      throw std::runtime_error(fmt::format("{}: message {}: {}", file.string(), message.name, problem));
    }
    messages.push_back(bus_message(id, message, traffic, fallback_ms));
  }
  return messages;
}

}  // namespace striker::sil

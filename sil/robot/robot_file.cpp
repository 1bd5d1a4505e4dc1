// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/robot_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/host/files.hpp"

namespace striker::sil {

namespace {

using core::RobotDescription;

struct Key {
  std::string_view name;
  std::int32_t RobotDescription::*member;
  std::int64_t least;
  std::int64_t greatest;
  std::optional<std::int32_t> otherwise = {};
};
constexpr std::array keys = {
    Key{"body_mass_g", &RobotDescription::body_mass_g, 200, 100'000},
    Key{"wheel_mass_g", &RobotDescription::wheel_mass_g, 1, 10'000},
    Key{"wheel_radius_um", &RobotDescription::wheel_radius_um, 10'000, 200'000},
    Key{"axle_length_um", &RobotDescription::axle_length_um, 40'000, 1'000'000},
    Key{"torque_limit_mNm", &RobotDescription::torque_limit_mNm, 10, 32'000},
    Key{"top_rim_speed_mm_s", &RobotDescription::top_rim_speed_mm_s, 100, 8'000},
    Key{"camera_latency_ms", &RobotDescription::camera_latency_ms, 0, 50, 0},
    Key{"command_delay_ms", &RobotDescription::command_delay_ms, 0, 50, 0},
    Key{"tyre_friction_percent", &RobotDescription::tyre_friction_percent, 10, 1'000, 300}};

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file, what));
}

void refuse_unknown(const toml::table& table, const std::string& file) {
  for (const auto& entry : table) {
    const toml::key& key = entry.first;
    const auto* const known =
        std::find_if(keys.begin(), keys.end(), [&](const Key& one) { return one.name == key.str(); });
    if (known == keys.end()) {
      std::string names;
      for (const Key& one : keys) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
      }
      fail(file, fmt::format("line {}: '{}' is no key of a robot; there are {}", key.source().begin.line,
                             key.str(), names));
    }
  }
}

std::int32_t value_of(const Key& key, const toml::table& table, const std::string& file) {
  const toml::node* const node = table.get(key.name);
  if (node == nullptr) {
    if (!key.otherwise) {
      fail(file, fmt::format("{} is missing: give a whole number from {} to {}", key.name, key.least,
                             key.greatest));
    }
    return *key.otherwise;
  }
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < key.least || *value > key.greatest) {
    fail(file, fmt::format("line {}: {}{} must be a whole number from {} to {}", node->source().begin.line,
                           key.name, value ? fmt::format(" = {}", *value) : "", key.least, key.greatest));
  }
  return static_cast<std::int32_t>(*value);
}

}  // namespace

RobotDescription read_robot(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = host::read_file(file);
  RobotDescription robot{};
  try {
    const toml::table table = toml::parse(text, name);
    refuse_unknown(table, name);
    for (const Key& key : keys) {
      robot.*key.member = value_of(key, table, name);
    }
  } catch (const toml::parse_error& error) {
    fail(name, fmt::format("line {}: {}", error.source().begin.line, std::string(error.description())));
  }
  if (!core::loops_fit(core::profile_of(robot))) {
    fail(
        name,
        "its wheel loops would not fit 32 bits, or have no gain at all: look at mass, radius and torque again");
  }
  return robot;
}

}  // namespace striker::sil

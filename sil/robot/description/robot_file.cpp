// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/description/robot_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/core/robot_ranges.hpp"
#include "firmware/host/files.hpp"

namespace striker::sil {

namespace {

using core::RobotDescription;

using core::RobotKey;

using can::DriveWiring;
using can::WiringKey;

constexpr std::string_view drives_key = "drives";

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file, what));
}

void refuse_unknown(const toml::table& table, const std::string& file) {
  for (const auto& entry : table) {
    const toml::key& key = entry.first;
    const auto is_named = [&](const auto& one) { return one.name == key.str(); };
    if (key.str() != drives_key && std::none_of(core::robot_keys.begin(), core::robot_keys.end(), is_named) &&
        std::none_of(can::wiring_keys.begin(), can::wiring_keys.end(), is_named)) {
      std::string names;
      for (const RobotKey& one : core::robot_keys) {
        names += fmt::format("{}, ", one.name);
      }
      names += drives_key;
      for (const WiringKey& one : can::wiring_keys) {
        names += fmt::format(", {}", one.name);
      }
      fail(file, fmt::format("line {}: '{}' is no key of a robot; there are {}", key.source().begin.line,
                             key.str(), names));
    }
  }
}

std::int32_t value_of(const RobotKey& key, const toml::table& table, const std::string& file) {
  const toml::node* const node = table.get(key.name);
  if (node == nullptr) {
    if (!key.may_be_left_out) {
      fail(file, fmt::format("{} is missing: give a whole number from {} to {}", key.name, key.least,
                             key.greatest));
    }
    return RobotDescription{}.*key.member;
  }
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < key.least || *value > key.greatest) {
    fail(file, fmt::format("line {}: {}{} must be a whole number from {} to {}", node->source().begin.line,
                           key.name, value ? fmt::format(" = {}", *value) : "", key.least, key.greatest));
  }
  return static_cast<std::int32_t>(*value);
}

can::DriveKind kind_of(const toml::table& table, const std::string& file) {
  const toml::node* const node = table.get(drives_key);
  if (node == nullptr) {
    return can::DriveKind::striker;
  }
  const auto name = node->value_exact<std::string>();
  const auto& names = can::drive_kind_names;
  const auto* const found = std::find(names.begin(), names.end(), name.value_or(""));
  if (found == names.end()) {
    fail(file, fmt::format("line {}: drives{} must be one of \"{}\"", node->source().begin.line,
                           name ? fmt::format(" = \"{}\"", *name) : "", fmt::join(names, "\", \"")));
  }
  return static_cast<can::DriveKind>(found - names.begin());
}

std::int32_t value_of(const WiringKey& key, const toml::table& table, const std::string& file) {
  const RobotKey known = {key.name, nullptr, key.least, key.greatest, true};
  return table.contains(key.name) ? value_of(known, table, file) : DriveWiring{}.*key.member;
}

DriveWiring wiring_of(const toml::table& table, const RobotDescription& robot, const std::string& file) {
  DriveWiring wiring;
  wiring.kind = kind_of(table, file);
  for (const WiringKey& key : can::wiring_keys) {
    wiring.*key.member = value_of(key, table, file);
  }
  wiring.wheel_radius_um = robot.wheel_radius_um;
  if (wiring.left_node == wiring.right_node) {
    fail(file,
         fmt::format("drive_left_node and drive_right_node are both {}: each drive has a node of its own",
                     wiring.left_node));
  }
  if (wiring.identifier_base % 8 != 0) {
    fail(file, fmt::format("identifier_base = {} must be a multiple of 8", wiring.identifier_base));
  }
  if (!can::torque_fits(wiring, robot.torque_limit_mNm)) {
    fail(file,
         fmt::format(
             "torque_limit_mNm = {} is {} per mille of the motor's rated torque at the wheel, which must be "
             "{} to {}: look at drive_rated_torque_mNm and drive_gear_percent",
             robot.torque_limit_mNm, can::limit_per_mille(wiring, robot.torque_limit_mNm),
             can::least_limit_per_mille, can::greatest_limit_per_mille));
  }
  if (!can::speed_fits(wiring, core::greatest_measured_mm_s)) {
    fail(file,
         fmt::format(
             "drive_counts_per_turn = {} makes {} counts/s of the greatest speed that is measured, {} mm/s, "
             "which do not fit 32 bits: look at it, drive_gear_percent and wheel_radius_um",
             wiring.counts_per_turn, can::counts_per_s(wiring, core::greatest_measured_mm_s),
             core::greatest_measured_mm_s));
  }
  return wiring;
}

std::string_view line_of(std::string_view text, std::uint32_t number) {
  for (std::uint32_t line = 1; line < number; ++line) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return text.substr(0, text.find('\n'));
}

// TOML has more ways to write a whole number, of which the firmware's build, without a TOML library, knows the plainest.
void refuse_fancy(const toml::table& table, std::string_view text, const std::string& file) {
  for (const auto& [key, node] : table) {
    const toml::source_position begin = node.source().begin;
    const std::string_view line = line_of(text, begin.line);
    const std::string_view number = line.substr(std::min<std::size_t>(begin.column - 1, line.size()));
    const bool quoted = line.substr(0, begin.column - 1).find_first_of("\"'") != std::string_view::npos;
    if (key.str() == drives_key) {
      if (line.substr(0, begin.column - 1).find_first_of("\"'") != std::string_view::npos ||
          !number.starts_with('"')) {
        fail(file,
             fmt::format("line {}: '{}' is no name of drives, as in drives = \"odrive\"", begin.line, line));
      }
      continue;
    }
    const bool plain = !number.empty() && number[0] >= '0' && number[0] <= '9' &&
                       (number.size() < 2 || number[0] != '0' || number.find_first_of("xob") != 1);
    if (quoted || !plain) {
      fail(file, fmt::format("line {}: '{}' is no key with a whole number, as in body_mass_g = 1_500",
                             begin.line, line));
    }
  }
}

}  // namespace

RobotDescription read_robot(const std::filesystem::path& file) {
  return read_robot_and_drives(file).robot;
}

RobotAndDrives read_robot_and_drives(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = host::read_file(file, host::most_text_bytes);
  RobotDescription robot{};
  DriveWiring wiring;
  try {
    const toml::table table = toml::parse(text, name);
    refuse_unknown(table, name);
    for (const RobotKey& key : core::robot_keys) {
      robot.*key.member = value_of(key, table, name);
    }
    refuse_fancy(table, text, name);
    wiring = wiring_of(table, robot, name);
  } catch (const toml::parse_error& error) {
    fail(name, fmt::format("line {}: {}", error.source().begin.line, std::string(error.description())));
  }
  if (!core::wheels_are_heavy_enough(robot)) {
    fail(name,
         fmt::format(
             "wheel_mass_g = {} is too little for torque_limit_mNm = {} and wheel_radius_um = {}: in the air "
             "a rim would gain {} mm/s in a ms, and {} at most is told from a broken sensor",
             robot.wheel_mass_g, robot.torque_limit_mNm, robot.wheel_radius_um,
             core::free_rim_gain_mm_s(robot), core::greatest_free_rim_gain_mm_s));
  }
  if (!core::loops_fit(core::profile_of(robot))) {
    fail(name,
         "its wheel loops would not fit 32 bits, or have no gain at all: look at body_mass_g, wheel_mass_g, "
         "wheel_radius_um and torque_limit_mNm again");
  }
  return {.robot = robot, .wiring = wiring};
}

}  // namespace striker::sil

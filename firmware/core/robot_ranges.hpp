// SPDX-License-Identifier: Apache-2.0
// What a robot's description may hold: its members by their names in a file, with their ranges. For the files
// (sil/robot/description/robot_file.hpp), and for the robot that a build is for (firmware/loop/built_in_robot.hpp).
// Torque and speed end where a WheelCommand does (firmware/can/messages/drives.hpp): beyond, a frame would say less than
// the controller reckons with; so does a field where a VisionPose does.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/core/robot_profile.hpp"

namespace striker::core {

struct RobotKey {
  std::string_view name;
  std::int32_t RobotDescription::*member;
  std::int32_t least;
  std::int32_t greatest;
  bool may_be_left_out = false;  // it has its usual value then, RobotDescription's own
};

inline constexpr std::array robot_keys = {
    RobotKey{"body_mass_g", &RobotDescription::body_mass_g, 200, 100'000},
    RobotKey{"wheel_mass_g", &RobotDescription::wheel_mass_g, 1, 10'000},
    RobotKey{"wheel_radius_um", &RobotDescription::wheel_radius_um, 10'000, 200'000},
    RobotKey{"axle_length_um", &RobotDescription::axle_length_um, 40'000, 1'000'000},
    RobotKey{"torque_limit_mNm", &RobotDescription::torque_limit_mNm, 10, 2'000},
    RobotKey{"top_rim_speed_mm_s", &RobotDescription::top_rim_speed_mm_s, 100, 4'000},
    RobotKey{"camera_latency_ms", &RobotDescription::camera_latency_ms, 0, 50, true},
    RobotKey{"camera_rate_Hz", &RobotDescription::camera_rate_Hz, 10, 100, true},
    RobotKey{"command_delay_ms", &RobotDescription::command_delay_ms, 0, 50, true},
    RobotKey{"tyre_friction_percent", &RobotDescription::tyre_friction_percent, 10, 1'000, true},
    RobotKey{"field_half_length_mm", &RobotDescription::field_half_length_mm, 0, 8'000, true},
    RobotKey{"field_half_width_mm", &RobotDescription::field_half_width_mm, 0, 8'000, true}};

[[nodiscard]] constexpr bool in_range(const RobotDescription& robot) {
  return std::all_of(robot_keys.begin(), robot_keys.end(), [&](const RobotKey& key) {
    return robot.*key.member >= key.least && robot.*key.member <= key.greatest;
  });
}

// What the rim of a wheel in the air gains in a tick at the torque limit: a disc's, torque over half its mass and its
// radius. Of a wheel that jumps by more than 1,000 mm/s (estimation/plausibility.cpp) the controller thinks that its sensor
// is broken: a robot whose own wheels come near that would stop at every contact.
[[nodiscard]] constexpr std::int64_t free_rim_gain_mm_s(const RobotDescription& robot) {
  return 2'000'000 * std::int64_t{robot.torque_limit_mNm} /
         (std::int64_t{robot.wheel_radius_um} * robot.wheel_mass_g);
}
inline constexpr std::int64_t greatest_free_rim_gain_mm_s = 800;
[[nodiscard]] constexpr bool wheels_are_heavy_enough(const RobotDescription& robot) {
  return free_rim_gain_mm_s(robot) <= greatest_free_rim_gain_mm_s;
}

static_assert(in_range(forward) && in_range(defender) && in_range(goalkeeper));
static_assert(free_rim_gain_mm_s(forward) == 200 && free_rim_gain_mm_s(defender) == 600);

}  // namespace striker::core

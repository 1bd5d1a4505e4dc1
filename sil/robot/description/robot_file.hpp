// SPDX-License-Identifier: Apache-2.0
// A robot's description as a file: TOML, whole numbers in the units of core::RobotDescription
// (firmware/core/robot_profile.hpp), each key one of its members, in decimal and without quotes. firmware/robots/ holds AI
// Soccer's three roles.
//
//   body_mass_g = 2_200             200 to 100,000
//   wheel_mass_g = 120              each; 1 to 10,000, and enough for the torque (firmware/core/robot_ranges.hpp)
//   wheel_radius_um = 50_000        10,000 to 200,000
//   axle_length_um = 200_000        between the wheels' centres; 40,000 to 1,000,000
//   torque_limit_mNm = 600          of each wheel; 10 to 2,000
//   top_rim_speed_mm_s = 1_500      100 to 4,000
//   camera_latency_ms = 35          0 to 50; left out: 0
//   camera_rate_Hz = 60             pictures a second; 10 to 100; left out: 20, one for every decision
//   command_delay_ms = 20           0 to 50; left out: 0
//   tyre_friction_percent = 80      10 to 1,000; left out: 300, AI Soccer's
//   field_half_length_mm = 3_900    where a kick ends, along x from the origin; 0 to 8,000; left out: 0, nowhere
//   field_half_width_mm = 2_325     along y, likewise
//
// And how its wheels are driven, if not by Striker's own drives: drives, identifier_base and drive_...
// (firmware/can/drives/drive_wiring.hpp).
#pragma once

#include <filesystem>

#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::sil {

// Throws std::runtime_error with one line that names file, line, key, value and what is allowed; also where the wheel
// loops could not serve such a robot (core::loops_fit).
[[nodiscard]] core::RobotDescription read_robot(const std::filesystem::path& file);

struct RobotAndDrives {
  core::RobotDescription robot;
  can::DriveWiring wiring;
};
[[nodiscard]] RobotAndDrives read_robot_and_drives(const std::filesystem::path& file);

}  // namespace striker::sil

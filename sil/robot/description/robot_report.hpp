// SPDX-License-Identifier: Apache-2.0
// What follows from a robot's description: how fast it gets on and stops, and how its wheel loops are tuned. All of it
// is arithmetic on the description; nothing is simulated.
//
//   fmt::print("{}", robot_report(figures_of(read_robot("mine.toml"))));
#pragma once

#include <filesystem>
#include <string>

#include "firmware/core/robot_profile.hpp"

namespace striker::sil {

struct DescribedFigures {
  double moved_mass_kg = 0.0;      // with the wheels' spin
  double acceleration_m_s2 = 0.0;  // at the torque limit, if the tyres hold
  // Friction times gravity, as if the wheels carried all the weight: the skids carry some of it while the robot
  // accelerates.
  double grip_m_s2 = 0.0;
  double top_speed_m_s = 0.0;
  double time_to_top_s = 0.0;  // and to stop from there
  double way_to_top_m = 0.0;
  double turn_rate_rad_s = 0.0;  // with the wheels at top speed, against each other

  // The wheel loops, both wheels together against the robot's mass, as profile_of rounds them.
  double kp_mNm_s_mm = 0.0;
  double ki_mNm_mm = 0.0;
  double delay_ms = 0.0;  // of the loop: 3 ms, and half of the commands' (robot_profile.hpp)
  double crossover_rad_s = 0.0;
  double phase_margin_deg = 0.0;
  double gain_margin = 0.0;  // a robot this many times as light or strong is at the edge of stability

  double camera_rate_Hz = 0.0;
  double camera_latency_ms = 0.0;
  double field_half_length_m = 0.0;  // 0: no border
  double field_half_width_m = 0.0;
  double motion_ms = 0.0;           // between the two pictures that tell a velocity
  double velocity_step_mm_s = 0.0;  // that a count of the ball's position makes, on the bus 0.25 mm

  double slip_m_s2 = 0.0;  // a wheel that gains more than this is taken to slip
  double overspeed_m_s = 0.0;
};

// Of a description that read_robot takes.
[[nodiscard]] DescribedFigures figures_of(const core::RobotDescription& robot);

// Lines of text, with what is out of the ordinary.
[[nodiscard]] std::string robot_report(const DescribedFigures& figures);

// `policy`: whether the built-in one fits. Throws as host::AtomicFile does.
void write_robot_json(const DescribedFigures& figures, const std::string& source, bool policy_fits,
                      const std::filesystem::path& file);

}  // namespace striker::sil

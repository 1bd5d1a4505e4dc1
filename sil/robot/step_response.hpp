// SPDX-License-Identifier: Apache-2.0
// What a robot makes of steps of its set-point: the firmware's wheel loops (firmware/core/wheel_loop.hpp) on torque
// drives, tyres and wheel bodies of the full world, on an open floor, with nothing between them but the command's delay.
//
//   for (const StepRow& row : step_response(core::forward, variation_of("mass=0.9"), {.set_point_m_s = 1.0})) ...
//
// Stands for `step_ms`, then both wheels are told the set-point, its opposite and 0, for as long each. Deterministic.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/core/robot_profile.hpp"
#include "sil/robot/variation.hpp"

namespace striker::sil {

struct StepOptions {
  double set_point_m_s = 0.0;  // of both rims; 0: the robot's top speed
  std::uint32_t step_ms = 500;
  bool turns = false;  // the left rim is told the opposite of the right one
};

// A ms of it, of the right wheel and of the robot: what the loop read, and what it told in answer.
struct StepRow {
  std::uint32_t time_ms = 0;
  std::int32_t set_point_mm_s = 0;
  std::int32_t measured_mm_s = 0;  // by the encoder
  std::int32_t rolling_mm_s = 0;   // of a rim that grips, as the loop has it
  std::int32_t torque_mNm = 0;
  double moved_mm_s = 0.0;  // what the floor passes by under the right wheel
};

// `variation` is completed with the description (variation.hpp). Throws std::runtime_error where the set-point is beyond
// the robot's top speed, and where camera or ball are varied.
[[nodiscard]] std::vector<StepRow> step_response(const core::RobotDescription& robot,
                                                 const Variation& variation, const StepOptions& options);

// When the floor under the right wheel passed by with a tenth and with nine tenths of the first step, and how far beyond
// the step it went, in % of it; times are -1 where it did not come to that. A rim that spins is no step followed.
struct StepFigures {
  int tenth_ms = -1;
  int nine_tenths_ms = -1;
  double overshoot_percent = 0.0;
  double greatest_slip_mm_s = 0.0;  // between rim and floor
  int slipping_ms = 0;  // in which that was more than a tenth of the set-point and 50 mm/s, of all steps
};

[[nodiscard]] std::string step_table(const StepFigures& figures);

[[nodiscard]] StepFigures figures_of(const std::vector<StepRow>& rows, const StepOptions& options);

// time_ms,set_point_mm_s,measured_mm_s,rolling_mm_s,torque_mNm,moved_mm_s
[[nodiscard]] std::string step_csv(const std::vector<StepRow>& rows);

}  // namespace striker::sil

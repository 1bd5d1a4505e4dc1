// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/field_border.hpp"

#include <algorithm>

#include "firmware/core/estimation/angle.hpp"
#include "firmware/core/estimation/magnitude.hpp"

namespace striker::core {

namespace {

// Beyond the border, and on the way out.
constexpr bool is_out(std::int32_t now_um, std::int32_t way_um, std::int32_t border_um) {
  const std::int32_t then_um = now_um + way_um;
  return border_um != 0 && magnitude(then_um) > border_um && way_um != 0 && (then_um < 0) == (way_um < 0);
}

}  // namespace

bool leaves_field(const RobotProfile& robot, const Estimate& now, const WheelSpeeds& set_point) {
  const std::int32_t speed_mm_s = now.robot_speed_mm_s;
  const std::int32_t wanted_mm_s = (set_point.left_mm_s + set_point.right_mm_s) / 2;
  const std::int32_t then_mm_s =
      speed_mm_s + std::clamp(wanted_mm_s - speed_mm_s, -robot.decision_gain_mm_s, robot.decision_gain_mm_s);
  const std::int32_t faster_mm_s = magnitude(then_mm_s) < magnitude(speed_mm_s) ? speed_mm_s : then_mm_s;
  const std::int32_t ticks = static_cast<std::int32_t>(decision_period_ticks) + robot.braking_late_ticks;
  // v^2 / (2 a) is the way to stop from v.
  const std::int32_t stop_um = 8 * then_mm_s * magnitude(then_mm_s) / robot.braking_q4;
  const Vector way = rotate({faster_mm_s * ticks + stop_um, 0}, now.heading);
  return is_out(now.robot_um.x, way.x, robot.field_half_length_um) ||
         is_out(now.robot_um.y, way.y, robot.field_half_width_um);
}

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/field_border.hpp"

#include <algorithm>

#include "firmware/core/estimation/angle.hpp"

namespace striker::core {

namespace {

constexpr std::int32_t magnitude(std::int32_t value) {
  return value < 0 ? -value : value;
}

// Beyond the border, and on the way out.
constexpr bool is_out(std::int32_t now_um, std::int32_t way_um, std::int32_t border_mm) {
  return border_mm != 0 && magnitude(now_um + way_um) > 1'000 * border_mm &&
         (now_um + way_um < 0) == (way_um < 0);
}

}  // namespace

bool leaves_field(const RobotProfile& robot, const Estimate& now, const WheelSpeeds& set_point) {
  // A tick changes the speed by so much at the torque limit, in 16ths of mm/s; v^2 / (2 a) is the way to stop from v.
  const std::int32_t gain_q4 = std::max<std::int32_t>(robot.slip_gain_q12 * robot.torque_limit_mNm / 256, 1);
  const auto ticks = static_cast<std::int32_t>(decision_period_ticks);
  const std::int32_t most_mm_s = ticks * gain_q4 / 16 + 1;
  const std::int32_t speed_mm_s = now.robot_speed_mm_s;
  const std::int32_t wanted_mm_s = (set_point.left_mm_s + set_point.right_mm_s) / 2;
  const std::int32_t then_mm_s = speed_mm_s + std::clamp(wanted_mm_s - speed_mm_s, -most_mm_s, most_mm_s);
  const std::int32_t faster_mm_s = magnitude(then_mm_s) < magnitude(speed_mm_s) ? speed_mm_s : then_mm_s;
  const Vector way =
      rotate({faster_mm_s * ticks + 8 * then_mm_s * magnitude(then_mm_s) / gain_q4, 0}, now.heading);
  return is_out(now.robot_um.x, way.x, robot.field_half_length_mm) ||
         is_out(now.robot_um.y, way.y, robot.field_half_width_mm);
}

}  // namespace striker::core

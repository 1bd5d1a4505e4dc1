// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/wheel_loop.hpp"

#include <algorithm>

namespace striker::core {

std::int32_t WheelLoop::step(const RobotProfile& robot, std::int32_t set_point_mm_s,
                             std::int32_t measured_mm_s, std::int32_t limit_mNm, PendingTorque& pending) {
  const std::int32_t coming_mm_s = std::clamp(measured_mm_s + pending.speed_change_mm_s(robot),
                                              -greatest_measured_mm_s, greatest_measured_mm_s);
  const std::int32_t error_mm_s = set_point_mm_s - coming_mm_s;
  const std::int32_t wanted_mNm = ((error_mm_s * robot.kp_q8) >> 8) + (integral_q16_ >> 16);
  std::int32_t torque_mNm = std::clamp(wanted_mNm, -limit_mNm, limit_mNm);
  if (robot.command_delay_ticks != 0) {
    // What brakes may still be on its way: the check of commands sees the measured speed alone.
    torque_mNm = measured_mm_s > robot.overspeed_mm_s    ? std::min<std::int32_t>(torque_mNm, 0)
                 : measured_mm_s < -robot.overspeed_mm_s ? std::max<std::int32_t>(torque_mNm, 0)
                                                         : torque_mNm;
  }
  slip_.acts(pending.give(robot, torque_mNm));
  const bool winds_up =
      (wanted_mNm > limit_mNm && error_mm_s > 0) || (wanted_mNm < -limit_mNm && error_mm_s < 0);
  if (!winds_up) {
    const std::int32_t integral_limit_q16 = limit_mNm * 65536;
    // Of the measured error: what is on its way against a steady load is no speed to come.
    integral_q16_ = std::clamp(integral_q16_ + (set_point_mm_s - measured_mm_s) * robot.ki_tick_q16,
                               -integral_limit_q16, integral_limit_q16);
  }
  return torque_mNm;
}

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The wheel-speed loops: a PI controller for each wheel, once a tick (1 kHz), from rim speed to torque, with a
// torque limit, a slip limiter (slip_limiter.hpp), and anti-windup by conditional integration. Gains and limit are the
// robot's (RobotProfile). Where commands are late, the proportional part takes the speed that is to come
// (pending_torque.hpp), and the integral the measured one, so that a steady load leaves no error.
#pragma once

#include <cstdint>

#include "firmware/core/actions.hpp"
#include "firmware/core/pending_torque.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/slip_limiter.hpp"

namespace striker::core {

class WheelLoop {
 public:
  // The torque for this tick, in mNm, within the profile's limit. Speeds within +-8000 mm/s.
  [[nodiscard]] std::int32_t step(const RobotProfile& robot, std::int32_t set_point_mm_s,
                                  std::int32_t measured_mm_s, PendingTorque& pending);

  // In the tick that the next measurement tells of: the last torque, or an earlier one if commands are late.
  [[nodiscard]] std::int32_t acting_mNm() const { return slip_.acting_mNm(); }

 private:
  std::int32_t integral_q16_ = 0;  // mNm in Q16
  SlipLimiter slip_;
};

class WheelLoops {
 public:
  void reset() { *this = {}; }
  [[nodiscard]] WheelTorques step(const RobotProfile& robot, const WheelSpeeds& set_point,
                                  const WheelSpeeds& measured, PendingTorques& pending) {
    return {left_.step(robot, set_point.left_mm_s, measured.left_mm_s, pending.left),
            right_.step(robot, set_point.right_mm_s, measured.right_mm_s, pending.right)};
  }
  [[nodiscard]] WheelTorques acting() const { return {left_.acting_mNm(), right_.acting_mNm()}; }

 private:
  WheelLoop left_;
  WheelLoop right_;
};

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The wheel-speed loops: a PI controller for each wheel, once a tick (1 kHz), from rim speed to torque, with a
// torque limit, a slip limiter (slip_limiter.hpp), and anti-windup by conditional integration. Gains and limit are the
// robot's (RobotProfile). Where commands are late, the proportional part takes the speed that is to come
// (pending_torque.hpp), and the integral the measured one, so that a steady load leaves no error.
//
//   const WheelSpeeds rolling = loops.see(robot, measured);  // for what wants to know how the robot moves
//   const WheelTorques torque = loops.step(robot, set_point, measured, pending);
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/core/actions.hpp"
#include "firmware/core/pending_torque.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/slip_limiter.hpp"

namespace striker::core {

class WheelLoop {
 public:
  WheelLoop() = default;
  explicit WheelLoop(std::int32_t rolling_mm_s) : slip_(rolling_mm_s) {}

  // Once for each measurement, before the step. Speeds within +-8000 mm/s.
  void see(const RobotProfile& robot, std::int32_t measured_mm_s) { slip_.see(robot, measured_mm_s); }
  [[nodiscard]] std::int32_t rolling_mm_s() const { return slip_.rolling_mm_s(); }
  [[nodiscard]] std::int32_t limit_mNm(const RobotProfile& robot) const { return slip_.limit_mNm(robot); }

  // The torque for this tick, in mNm, within the limit.
  [[nodiscard]] std::int32_t step(const RobotProfile& robot, std::int32_t set_point_mm_s,
                                  std::int32_t measured_mm_s, std::int32_t limit_mNm, PendingTorque& pending);

  // In the tick that the next measurement tells of: the last torque, or an earlier one if commands are late.
  [[nodiscard]] std::int32_t acting_mNm() const { return slip_.acting_mNm(); }

 private:
  std::int32_t integral_q16_ = 0;  // mNm in Q16
  SlipLimiter slip_;
};

class WheelLoops {
 public:
  void reset(const WheelSpeeds& measured) {
    left_ = WheelLoop(measured.left_mm_s);
    right_ = WheelLoop(measured.right_mm_s);
  }

  // The speeds of rims that grip: those measured, unless a wheel spins. Where commands are late nothing tells for sure that
  // one does, and it is those measured.
  WheelSpeeds see(const RobotProfile& robot, const WheelSpeeds& measured) {
    left_.see(robot, measured.left_mm_s);
    right_.see(robot, measured.right_mm_s);
    return robot.command_delay_ticks != 0 ? measured
                                          : WheelSpeeds{left_.rolling_mm_s(), right_.rolling_mm_s()};
  }

  // Neither wheel gets more than the one that grips less, or the robot would turn.
  [[nodiscard]] WheelTorques step(const RobotProfile& robot, const WheelSpeeds& set_point,
                                  const WheelSpeeds& measured, PendingTorques& pending) {
    const std::int32_t limit_mNm = std::min(left_.limit_mNm(robot), right_.limit_mNm(robot));
    return {left_.step(robot, set_point.left_mm_s, measured.left_mm_s, limit_mNm, pending.left),
            right_.step(robot, set_point.right_mm_s, measured.right_mm_s, limit_mNm, pending.right)};
  }
  [[nodiscard]] WheelTorques acting() const { return {left_.acting_mNm(), right_.acting_mNm()}; }

 private:
  WheelLoop left_;
  WheelLoop right_;
};

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The final check of every drive command, after everything else: what does not have a cause in this tick, or
// breaks a limit of the robot, does not go out.
//
// It sees the same percepts and the same supervisor as the rest of the controller: it catches a mistake of
// the pilot or of the loops, not one of the receiver.
#pragma once

#include "firmware/core/actions.hpp"
#include "firmware/core/estimation/magnitude.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::core {

struct DriveFacts {
  bool armed = false;  // state active, no fault latched
  bool vision_fresh = false;
  bool wheels_fresh = false;
  WheelSpeeds measured;
};

namespace detail {

constexpr bool drives_overspeed(const RobotProfile& robot, std::int32_t torque_mNm, std::int32_t speed_mm_s) {
  return magnitude(speed_mm_s) > robot.overspeed_mm_s && torque_mNm != 0 &&
         (torque_mNm > 0) == (speed_mm_s > 0);
}

constexpr bool within_limits(const RobotProfile& robot, const DriveCommand& command) {
  return magnitude(command.torque.left_mNm) <= robot.torque_limit_mNm &&
         magnitude(command.torque.right_mNm) <= robot.torque_limit_mNm &&
         magnitude(command.set_point.left_mm_s) <= robot.top_rim_speed_mm_s &&
         magnitude(command.set_point.right_mm_s) <= robot.top_rim_speed_mm_s;
}

}  // namespace detail

// `none` if the command may go out as it is; otherwise the fault to latch, and the command must be all zero.
[[nodiscard]] constexpr Fault check_command(const RobotProfile& robot, const DriveCommand& command,
                                            const DriveFacts& facts) {
  if (command == DriveCommand{}) {
    return Fault::none;
  }
  const bool has_cause = facts.armed && facts.vision_fresh && facts.wheels_fresh;
  if (!has_cause || !detail::within_limits(robot, command)) {
    return Fault::command_rejected;
  }
  if (detail::drives_overspeed(robot, command.torque.left_mNm, facts.measured.left_mm_s) ||
      detail::drives_overspeed(robot, command.torque.right_mNm, facts.measured.right_mm_s)) {
    return Fault::overspeed;
  }
  return Fault::none;
}

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// What a wheel was told and does not do yet, where commands take some ticks to become torque (the profile's
// `command_delay_ticks`; 0 to 50): which torque it gives now, and what the rest will add to its speed.
//
// A loop that controls the speed with that added controls a wheel without the delay, in effect (Smith 1957). It is as
// good as the description is: for a robot that is lighter than described the prediction is short by as much.
//
//   speed_mm_s = measured_mm_s + pending.speed_change_mm_s(robot);  ...;  acting_mNm = pending.give(robot, torque_mNm);
//
// Once a tick. Without a delay nothing is kept, and nothing changes.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/core/robot_profile.hpp"

namespace striker::core {

class PendingTorque {
 public:
  // Within the profile's limit. Returns the torque, to a 127th of the limit, that acts in the tick that the next
  // measurement tells of.
  [[nodiscard]] std::int32_t give(const RobotProfile& robot, std::int32_t torque_mNm) {
    if (robot.command_delay_ticks == 0) {
      return torque_mNm;
    }
    std::int8_t& kept = given_[next_];
    const std::int32_t acting_mNm = kept * robot.torque_limit_mNm / torque_steps;
    const std::int32_t given = torque_mNm * torque_steps / robot.torque_limit_mNm;
    sum_ += given - kept;
    kept = static_cast<std::int8_t>(given);
    next_ = next_ + 1 < static_cast<std::uint32_t>(robot.command_delay_ticks) ? next_ + 1 : 0;
    return acting_mNm;
  }

  // By this torque on both wheels.
  [[nodiscard]] std::int32_t speed_change_mm_s(const RobotProfile& robot) const {
    return robot.command_delay_ticks == 0 ? 0 : (sum_ * robot.pending_gain_q12) >> 12;
  }

 private:
  // A ring of as many as the delay has ticks. Sealed: whole words (seal.hpp).
  std::array<std::int8_t, greatest_delay_ticks + 2> given_{};
  std::uint32_t next_ = 0;
  std::int32_t sum_ = 0;
};

struct PendingTorques {
  PendingTorque left;
  PendingTorque right;

  // What is still to come adds this to the robot's speed.
  [[nodiscard]] std::int32_t speed_change_mm_s(const RobotProfile& robot) const {
    return (left.speed_change_mm_s(robot) + right.speed_change_mm_s(robot)) / 2;
  }
};

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/command_lead.hpp"

#include "firmware/core/estimation/angle.hpp"

namespace striker::core {

Estimate led_through_delay(const RobotProfile& robot, const Estimate& now, std::int32_t speed_change_mm_s) {
  const std::int32_t ticks = robot.command_delay_ticks;
  if (ticks == 0) {
    return now;
  }
  const Vector way = rotate({(now.robot_speed_mm_s + speed_change_mm_s / 2) * ticks, 0}, now.heading);
  Estimate then = now;
  then.robot_um = {now.robot_um.x + way.x, now.robot_um.y + way.y};
  then.robot_speed_mm_s += speed_change_mm_s;
  then.ball_um = {now.ball_um.x + now.ball_velocity_mm_s.x * ticks,
                  now.ball_um.y + now.ball_velocity_mm_s.y * ticks};
  return then;
}

}  // namespace striker::core

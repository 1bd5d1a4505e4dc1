// SPDX-License-Identifier: Apache-2.0
// What a controller does that knows its robot's delays: it leads what it saw to the moment at which its decision will
// act, the ball by its free roll, the robot along its heading by its own set-points (firmware/core/estimation does the
// same in integers). Delays count in physics steps here.
#pragma once

#include "firmware/core/robot_profile.hpp"
#include "sil/world/physics_constants.hpp"
#include "sil/world/planar_robot.hpp"
#include "sil/world/world.hpp"
#include "training/task/physics_step.hpp"

namespace striker::training {

// One physics step of the ball on its own.
inline void roll_on(sil::BallState& ball, double kept = sil::kept_in_10_ms) {
  auto& [position, velocity] = ball;
  position = {position.x + physics_step_s * velocity.x, position.y + physics_step_s * velocity.y};
  velocity = {kept * velocity.x, kept * velocity.y};
}

struct DescribedDelays {
  int command_steps = 0;  // from a decision to its torque
  int picture_steps = 0;  // from a picture to its decision

  // Decisions that have passed when one begins to act, the one that it ends then included.
  [[nodiscard]] constexpr int decisions_begun() const { return command_steps > 0 ? 1 : 0; }
};

// A delay that is no multiple of a physics step takes the next one.
[[nodiscard]] constexpr DescribedDelays described_delays(const core::RobotDescription& robot) {
  const auto steps = [](int delay_ms) { return (delay_ms + physics_step_ms - 1) / physics_step_ms; };
  return {.command_steps = steps(robot.command_delay_ms), .picture_steps = steps(robot.camera_latency_ms)};
}

}  // namespace striker::training

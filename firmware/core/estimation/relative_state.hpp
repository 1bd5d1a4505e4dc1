// SPDX-License-Identifier: Apache-2.0
// The paper's RCS state (section III): the ball in the robot's frame, in the corrected form.
//
// The inverse of the coordinate transformation matrix takes a point by rotation and translation, but a
// velocity by rotation alone: its homogeneous component is 0, not 1 as printed. The robot's speed is the
// signed one along its heading, not the printed sum of squares. Angles wrap. Units: policy.hpp.
#pragma once

#include <cstdint>

#include "firmware/core/estimation/estimator.hpp"
#include "firmware/policy/policy.hpp"

namespace striker::core {

// Below this speed the ball counts as at rest, and the direction of its movement is defined as 0.
inline constexpr std::int32_t rest_speed_mm_s = 20;

struct RelativeState {
  Vector ball_um;
  std::int32_t robot_speed_mm_s = 0;
  Vector ball_velocity_mm_s;
  std::int32_t ball_angle = 0;      // a binary angle
  std::int32_t decisions_left = 0;  // set by the controller: it counts the decisions
};

[[nodiscard]] RelativeState relative_state(const Estimate& estimate);

[[nodiscard]] std::int32_t element_of(const RelativeState& state, policy::StateElement element);

}  // namespace striker::core

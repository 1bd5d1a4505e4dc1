// SPDX-License-Identifier: Apache-2.0
// A robot on its line, and its next physics step.
#pragma once

#include <algorithm>

#include "sil/world/physics_constants.hpp"
#include "training/task/kick_environment.hpp"

namespace striker::training {

struct LineState {
  double position_m = 0.0;
  double speed_m_s = 0.0;
};

static_assert(physics_step_ms == 10, "kept_in_10_ms is what a physics step keeps");

// The next physics step (sil::straight_speed_m_s) of a robot that can gain so much.
inline void advance(LineState& robot, double set_point_m_s, double gain_limit_m_s) {
  const double moved_m_s =
      robot.speed_m_s + std::clamp(set_point_m_s - robot.speed_m_s, -gain_limit_m_s, gain_limit_m_s);
  robot.position_m += physics_step_s * moved_m_s;
  robot.speed_m_s = sil::kept_in_10_ms * moved_m_s;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// The worlds of a training step every 10 ms, five times a decision.
#pragma once

#include "sil/task/kick_task.hpp"

namespace striker::training {

inline constexpr int physics_step_ms = 10;
inline constexpr double physics_step_s = physics_step_ms / 1000.0;
inline constexpr int steps_per_decision = sil::decision_period_ms / physics_step_ms;
static_assert(steps_per_decision * physics_step_ms == sil::decision_period_ms);

}  // namespace striker::training

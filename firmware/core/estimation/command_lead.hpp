// SPDX-License-Identifier: Apache-2.0
// Where robot and ball will be when a command that is given now begins to act: what a decision is to be made for.
// The heading is taken as it is. Without a delay in the profile nothing changes. Once a decision.
#pragma once

#include <cstdint>

#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::core {

// `speed_change_mm_s` until then, as PendingTorques predicts it.
[[nodiscard]] Estimate led_through_delay(const RobotProfile& robot, const Estimate& now,
                                         std::int32_t speed_change_mm_s);

}  // namespace striker::core

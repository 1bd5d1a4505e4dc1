// SPDX-License-Identifier: Apache-2.0
// The two periods that everything in the controller counts in, and their only source.
//
// A tick is the period of the wheel loops; the controller steps once for each. A decision is one forward pass
// of the policy, once an AI Soccer frame (20 Hz; the paper, section IV). A policy carries the period that it
// was trained at, and the compiler refuses one that does not fit.
#pragma once

#include <cstdint>

namespace striker::core {

inline constexpr std::int32_t tick_us = 1'000;
inline constexpr std::uint32_t decision_period_ticks = 50;

inline constexpr std::int32_t decision_period_us = static_cast<std::int32_t>(decision_period_ticks) * tick_us;
inline constexpr std::int32_t decision_period_ms = decision_period_us / 1'000;

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The SysTick timer's registers: the same on every Cortex-M (Armv6-M Architecture Reference Manual, B3.3).
#pragma once

#include <cstdint>

namespace striker::cortex_m {

struct SysTick {
  std::uint32_t control;
  std::uint32_t reload;
  std::uint32_t value;
  std::uint32_t calibration;
};

inline constexpr std::uint32_t control_enable = 1U << 0U;
inline constexpr std::uint32_t control_interrupt = 1U << 1U;
inline constexpr std::uint32_t control_processor_clock = 1U << 2U;
inline constexpr std::uint32_t greatest_reload = 0xFFFFFF;

inline volatile SysTick& systick = *reinterpret_cast<volatile SysTick*>(0xE000E010);

}  // namespace striker::cortex_m

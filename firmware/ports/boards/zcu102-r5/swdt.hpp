// SPDX-License-Identifier: Apache-2.0
// The low-power domain's system watchdog timer of the Zynq UltraScale+ (AMD UG1087, module SWDT), as numbers: what its
// registers take. Each write needs the register's key.
#pragma once

#include <cstdint>

namespace striker::zcu102 {

inline constexpr std::uint32_t swdt_restart_key = 0x1999;
inline constexpr std::uint32_t swdt_mode_key = 0xABCU << 12U;
// Counts, and resets at 0; the pulse lengths are those after reset.
inline constexpr std::uint32_t swdt_run = swdt_mode_key | 0x1C0U | 1U << 1U | 1U << 0U;
inline constexpr std::uint32_t swdt_expired = 1U << 0U;  // of the status

// The counter takes eight clocks a count, and begins at 4,096 times the reload value, plus 4,095.
inline constexpr std::uint32_t swdt_clocks_a_count = 8;

// Of the control register: the shortest time-out that is no shorter than this one. Up to 1.3 s at 100 MHz.
[[nodiscard]] constexpr std::uint32_t swdt_control(std::uint32_t clock_hz, std::uint32_t timeout_ms) {
  constexpr std::uint32_t key = 0x248U << 14U;
  const std::uint32_t counts = clock_hz / swdt_clocks_a_count / 1'000 * timeout_ms;
  return key | (counts >> 12U) << 2U;
}

[[nodiscard]] constexpr std::uint32_t swdt_timeout_us(std::uint32_t control, std::uint32_t clock_hz) {
  const std::uint32_t counts = (control >> 2U & 0xFFFU) << 12U | 0xFFFU;
  return counts * 10 / (clock_hz / swdt_clocks_a_count / 100'000);
}

}  // namespace striker::zcu102

// SPDX-License-Identifier: Apache-2.0
// Ticks from the processor's cycle counter (Armv7-R Architecture Reference Manual, "The Performance Monitors
// Extension"), for emulation: on silicon its frequency is the boot loader's choice.
#include "firmware/ports/bare_metal/clock.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::uint32_t counts_a_us = STRIKER_CLOCK_HZ / 1'000'000;
constexpr std::uint32_t counts_a_tick = 1000 * counts_a_us;

std::uint32_t tick_count = 0;
std::uint32_t last_tick_at = 0;

std::uint32_t cycles() {
  std::uint32_t count = 0;
  asm volatile("mrc p15, 0, %0, c9, c13, 0" : "=r"(count));
  return count;
}

}  // namespace

void start_ticks() {
  constexpr std::uint32_t enable = 1U << 0U;
  constexpr std::uint32_t cycle_counter = 1U << 31U;
  asm volatile("mcr p15, 0, %0, c9, c12, 0" : : "r"(enable));
  asm volatile("mcr p15, 0, %0, c9, c12, 1" : : "r"(cycle_counter));
  last_tick_at = cycles();
}

std::uint32_t ticks() {
  const std::uint32_t passed = (cycles() - last_tick_at) / counts_a_tick;
  tick_count += passed;
  last_tick_at += passed * counts_a_tick;
  return tick_count;
}

std::uint32_t since_tick_us() {
  return (cycles() - last_tick_at) / counts_a_us;
}

}  // namespace striker::bare_metal

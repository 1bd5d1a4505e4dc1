// SPDX-License-Identifier: Apache-2.0
// Ticks from the first triple timer counter (AMD UG1087, module TTC). At 100 MHz its 32 bits wrap after 42 s:
// asked more often than that, it misses nothing.
#include "firmware/ports/bare_metal/clock.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::uintptr_t base = 0xFF110000;
constexpr std::uint32_t counts_a_us = STRIKER_CLOCK_HZ / 1'000'000;
constexpr std::uint32_t counts_a_tick = 1000 * counts_a_us;
constexpr std::uint32_t reset_and_run = 1U << 4U;  // of the counter control: overflow mode, upwards

volatile std::uint32_t& clock_control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x00);
volatile std::uint32_t& counter_control = *reinterpret_cast<volatile std::uint32_t*>(base + 0x0C);
volatile std::uint32_t& counter = *reinterpret_cast<volatile std::uint32_t*>(base + 0x18);

std::uint32_t tick_count = 0;
std::uint32_t last_tick_at = 0;

}  // namespace

void start_ticks() {
  clock_control = 0;
  counter_control = reset_and_run;
  last_tick_at = counter;
}

std::uint32_t ticks() {
  const std::uint32_t passed = (counter - last_tick_at) / counts_a_tick;
  tick_count += passed;
  last_tick_at += passed * counts_a_tick;
  return tick_count;
}

std::uint32_t since_tick_us() {
  return (counter - last_tick_at) / counts_a_us;
}

}  // namespace striker::bare_metal

// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/clock.hpp"
#include "firmware/ports/bare_metal/cortex_m/systick.hpp"

namespace striker::bare_metal {

namespace {

constexpr std::uint32_t counts_a_tick = STRIKER_CLOCK_HZ / 1000;

volatile std::uint32_t tick_count = 0;

}  // namespace

void start_ticks() {
  using namespace cortex_m;
  systick.reload = counts_a_tick - 1;
  systick.value = 0;
  systick.control = control_enable | control_interrupt | control_processor_clock;
}

std::uint32_t ticks() {
  return tick_count;
}

std::uint32_t since_tick_us() {
  return (counts_a_tick - 1 - cortex_m::systick.value) / (STRIKER_CLOCK_HZ / 1'000'000);
}

}  // namespace striker::bare_metal

extern "C" void tick_interrupt() {
  striker::bare_metal::tick_count = striker::bare_metal::tick_count + 1;
}

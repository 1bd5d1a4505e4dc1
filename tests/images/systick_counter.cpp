// SPDX-License-Identifier: Apache-2.0
// SysTick (Armv6-M and later Architecture Reference Manuals, "System timer"): 24 bits, counting down with the
// processor's clock, which STRIKER_CLOCK_HZ says for the board.
#include "firmware/ports/bare_metal/cortex_m/systick.hpp"
#include "tests/images/instruction_counter.hpp"

namespace striker::images {

CounterUnit counter_unit() {
  return {1'000'000'000 / 1'000'000, STRIKER_CLOCK_HZ / 1'000'000};
}

void restart_counter() {
  using namespace striker::cortex_m;
  systick.control = 0;
  systick.reload = greatest_reload;
  systick.value = 0;
  systick.control = control_enable | control_processor_clock;
}

std::uint32_t counted() {
  return cortex_m::greatest_reload - cortex_m::systick.value;
}

}  // namespace striker::images

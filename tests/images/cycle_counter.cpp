// SPDX-License-Identifier: Apache-2.0
// The performance monitors' cycle counter (Armv7-R Architecture Reference Manual, chapter C12). QEMU runs it
// at 1 GHz of virtual time: an instruction a count.
#include "tests/images/instruction_counter.hpp"

namespace striker::images {

CounterUnit counter_unit() {
  return {1, 1};
}

void restart_counter() {
  constexpr std::uint32_t enable_and_reset = 1U << 0U | 1U << 2U;
  constexpr std::uint32_t cycle_counter = 1U << 31U;
  asm volatile("mcr p15, 0, %0, c9, c12, 1" : : "r"(cycle_counter));
  asm volatile("mcr p15, 0, %0, c9, c12, 0" : : "r"(enable_and_reset));
}

std::uint32_t counted() {
  std::uint32_t count;
  asm volatile("mrc p15, 0, %0, c9, c13, 0" : "=r"(count));
  return count & 0xFFFFFF;
}

}  // namespace striker::images

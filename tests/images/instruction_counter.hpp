// SPDX-License-Identifier: Apache-2.0
// Counts instructions under QEMU's `-icount shift=0`, where an instruction takes one nanosecond of virtual
// time. On hardware the same timers count time.
#pragma once

#include <cstdint>

namespace striker::images {

// A count of the port's timer stands for this many instructions, as numerator and denominator.
struct CounterUnit {
  std::uint32_t instructions;
  std::uint32_t counts;
};
[[nodiscard]] CounterUnit counter_unit();

// Restarts the counter, in phase with the instruction that does it: equal work gives equal counts.
void restart_counter();

// Counts since then, less than 2^24.
[[nodiscard]] std::uint32_t counted();

}  // namespace striker::images

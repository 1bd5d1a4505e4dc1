// SPDX-License-Identifier: Apache-2.0
// What ended the run before this one: a record in RAM that a reset leaves alone.
//
// An exception, a broken stack or an expired watchdog ends in `end_by_fault`: it writes the record and resets
// the processor. No command goes out from there on, so the drives cut the torque by themselves, 10 ms after
// the last (the wheel command's timeout). The next run takes the record and tells it as a fault of its
// first tick: torque stays 0 until an operator has cleared it.
//
// Resets by a fault are counted from one power cycle to the next; after `most_resets` the processor stays
// stopped at start-up, silent on the bus, rather than start for ever. Only a power cycle that is long enough
// for the RAM to forget (a magic word and a check word no longer fit) starts it again. A reset by pin or
// debugger keeps the count, but tells no fault twice.
//
// The record's place is the last 32 bytes of the image's RAM, the linker script's `kept_fault`: a debugger
// reads it there, even from a stopped processor.
#pragma once

#include <cstdint>
#include <optional>

namespace striker::bare_metal {

inline constexpr std::uint32_t most_resets = 8;

enum class FaultCause : std::uint32_t {
  exception = 1,       // of the processor: FaultRecord says which, and where
  watchdog = 2,        // the loop completed no turn for watchdog_timeout_ms
  stack_overflow = 3,  // the stack went to its end or beyond it
  clock = 4,           // a clock did not start: neither ticks nor bits would have their time
};

struct FaultRecord {
  FaultCause cause = FaultCause::exception;
  // Cortex-M: the exception's number (IPSR; 2 NMI, 3 HardFault, 16 and on interrupts). Cortex-R: the vector's,
  // 1 undefined instruction to 7 FIQ. 0 where no exception was taken.
  std::uint32_t exception = 0;
  // Cortex-M: CFSR, 0 on Armv6-M, which has none. Cortex-R: IFSR of a prefetch abort, DFSR of a data abort.
  std::uint32_t status = 0;
  std::uint32_t pc = 0;      // the instruction that was hit, 0 where the stack could not tell it
  std::uint32_t resets = 0;  // by a fault since power-on, this one included: `end_by_fault` counts

  friend bool operator==(const FaultRecord&, const FaultRecord&) = default;
};

// As it lies in RAM. `check` covers what is before it.
struct KeptFault {
  std::uint32_t magic;
  FaultRecord record;
  std::uint32_t untold;  // 1 until a run has taken it
  std::uint32_t check;
};
static_assert(sizeof(KeptFault) == 32, "memory.ld.in keeps 32 bytes");

// Writes the record, with the resets counted, and resets the processor. From any context; 100 bytes of stack.
[[noreturn]] void end_by_fault(const FaultRecord& record);

// At start-up, before anything else: records the reset of a watchdog that raises no exception, and stops for
// good after too many.
void count_reset();

// The fault that ended the run before, once a run; nothing after a power cycle. The record stays readable.
[[nodiscard]] std::optional<FaultRecord> take_last_fault();

}  // namespace striker::bare_metal

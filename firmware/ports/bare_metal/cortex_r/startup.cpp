// SPDX-License-Identifier: Apache-2.0
// Reset and exceptions of the Cortex-R5F (Armv7-R Architecture Reference Manual, "Exception handling"). Both
// begin in Arm state; everything else is Thumb, as the kernel is.
//
// No interrupts: the port polls, so every exception is a fault. The core has no register for the vectors'
// address: they are copied to where its configuration looks for them, 0xFFFF0000 or 0. There has to be memory.
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/ports/bare_metal/cortex_r/memory_protection.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/memory.hpp"
#include "firmware/ports/bare_metal/reset.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

extern "C" {
extern const std::array<std::uint32_t, 16> exception_vectors;
extern std::uint32_t stack_bottom;
extern std::uint32_t stack_top;
int main();
[[noreturn]] void start();
}

// An exception leaves its mode for the supervisor's, which is the one that the firmware runs in, takes its stack
// pointer along, and begins the stack anew: it may be what is broken, and nothing returns.
asm(".section .vectors, \"ax\"\n\t"
    ".arm\n\t"
    ".syntax unified\n\t"
    ".global reset\n\t"
    ".type reset, %function\n"
    "reset:\n\t"
    "ldr sp, =stack_top\n\t"
    "ldr r0, =start\n\t"
    "bx r0\n\t"
    ".ltorg\n"
    "exception_vectors:\n\t"
    ".rept 8\n\t"
    "ldr pc, [pc, #24]\n\t"
    ".endr\n\t"
    ".word reset, exception_1, exception_2, exception_3, exception_4, exception_5, exception_6, exception_7\n"
    ".irp number, 1, 2, 3, 4, 5, 6, 7\n"
    "exception_\\number:\n\t"
    "mov r0, #\\number\n\t"
    "b exception\n\t"
    ".endr\n"
    "exception:\n\t"
    "mov r1, lr\n\t"
    "cpsid if, #0x13\n\t"
    "mov r2, sp\n\t"
    "ldr sp, =stack_top\n\t"
    "ldr r3, =take_exception\n\t"
    "bx r3\n\t"
    ".ltorg\n\t"
    ".text\n\t"
    ".thumb\n\t");

namespace {

enum Vector : std::uint32_t { prefetch_abort = 3, data_abort = 4 };

// How far the link register is ahead of the instruction, which is Thumb.
constexpr std::array<std::uint32_t, 8> ahead = {0, 2, 2, 4, 8, 0, 4, 4};

void copy_vectors() {
  constexpr std::uint32_t high_vectors = 1U << 13U;
  std::uint32_t control = 0;
  asm volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  auto* to = reinterpret_cast<volatile std::uint32_t*>((control & high_vectors) != 0 ? 0xFFFF0000 : 0);
  for (const std::uint32_t word : exception_vectors) {
    *to++ = word;
  }
  asm volatile("dsb\n\tmcr p15, 0, %0, c7, c5, 0\n\tisb" : : "r"(0) : "memory");  // instruction cache anew
}

std::uint32_t fault_status(std::uint32_t vector) {
  std::uint32_t status = 0;
  if (vector == prefetch_abort) {
    asm volatile("mrc p15, 0, %0, c5, c0, 1" : "=r"(status));
  } else if (vector == data_abort) {
    asm volatile("mrc p15, 0, %0, c5, c0, 0" : "=r"(status));
  }
  return status;
}

}  // namespace

extern "C" void start() {
  copy_vectors();
  striker::bare_metal::count_reset();
  striker::bare_metal::prepare_memory();
  striker::cortex_r::protect_memory();
  asm volatile("cpsie a" ::: "memory");  // aborts that come later than their access
  main();
  striker::bare_metal::stop_processor();
}

extern "C" [[noreturn, gnu::used]] void take_exception(std::uint32_t vector, std::uint32_t link,
                                                       const std::uint32_t* stack) {
  using namespace striker::bare_metal;
  // The push that aborts leaves the stack pointer above the guard, by 16 words or 16 double ones at most.
  constexpr std::uint32_t longest_push_words = 32;
  const bool pushed_into_guard = vector == data_abort && stack - longest_push_words < &stack_bottom;
  const bool overflow = stack < &stack_bottom || pushed_into_guard || !stack_is_intact();
  const FaultCause other = overflow ? FaultCause::stack_overflow : FaultCause::exception;
  end_by_fault({.cause = watchdog_has_expired() ? FaultCause::watchdog : other,
                .exception = vector,
                .status = fault_status(vector),
                .pc = link - ahead[vector]});
}

void striker::bare_metal::stop_processor() {
  asm volatile("cpsid if" ::: "memory");
  for (;;) {
    asm volatile("wfi");
  }
}

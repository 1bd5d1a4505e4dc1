// SPDX-License-Identifier: Apache-2.0
// Reset, the vector table and what every exception ends in (Armv6-M to Armv8.1-M Architecture Reference
// Manuals, "Exception model"). All are faults but the tick and what the board lists as HANDLERS. Nobody sets a priority: all
// of these have the highest that there is, and none interrupts another.
#include <array>
#include <cstdint>

#include "firmware/ports/bare_metal/cortex_m/memory_protection.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/memory.hpp"
#include "firmware/ports/bare_metal/reset.hpp"
#include "firmware/ports/bare_metal/watchdog.hpp"

extern "C" {
extern std::uint32_t stack_top;
[[noreturn]] void reset();
[[noreturn]] void exception();
void tick_interrupt();
int main();
#define STRIKER_HANDLER(line, name) void name();
STRIKER_HANDLERS
#undef STRIKER_HANDLER
}

namespace {

using Handler = void (*)();

struct VectorTable {
  std::uint32_t* initial_stack;
  Handler reset;
  std::array<Handler, 13> exceptions;  // NMI, HardFault and the other faults, SVCall, debug monitor, PendSV
  Handler tick;
  std::array<Handler, STRIKER_INTERRUPTS> interrupts;
};

template <std::size_t count>
constexpr std::array<Handler, count> all_are(Handler handler) {
  std::array<Handler, count> handlers{};
  handlers.fill(handler);
  return handlers;
}

constexpr auto interrupt_handlers() {
  auto handlers = all_are<STRIKER_INTERRUPTS>(exception);
#define STRIKER_HANDLER(line, name) handlers[line] = name;
  STRIKER_HANDLERS
#undef STRIKER_HANDLER
  return handlers;
}

[[gnu::section(".vectors"), gnu::used]] constexpr VectorTable vectors = {
    &stack_top, reset, all_are<13>(exception), tick_interrupt, interrupt_handlers()};

#ifdef __ARM_FP
constexpr std::uintptr_t coprocessor_access_control = 0xE000ED88;
constexpr std::uint32_t full_access_to_fpu = 0xFU << 20U;
#endif

constexpr std::uintptr_t reset_control = 0xE000ED0C;  // AIRCR
constexpr std::uint32_t request_reset = 0x05FA0004;

std::uint32_t fault_status() {
#if __ARM_ARCH >= 7
  constexpr std::uintptr_t configurable_fault_status = 0xE000ED28;
  return *reinterpret_cast<const volatile std::uint32_t*>(configurable_fault_status);
#else
  return 0;
#endif
}

}  // namespace

extern "C" void reset() {
#ifdef __ARM_FP
  // The FPU's registers, which are the vector unit's too, before the first instruction that names one.
  auto& access = *reinterpret_cast<volatile std::uint32_t*>(coprocessor_access_control);
  access = access | full_access_to_fpu;
  asm volatile("dsb\n\tisb" ::: "memory");
#endif
  striker::bare_metal::count_reset();
  striker::bare_metal::prepare_memory();
  striker::cortex_m::protect_memory();
  main();
  striker::bare_metal::stop_processor();
}

// The stack may be what is broken: its pointer is only read where the processor can have stored its frame, and
// begins anew, as nothing returns. On Armv8-M a frame that found no room leaves it at the limit, so the limit
// itself counts as none.
extern "C" [[gnu::naked]] void exception() {
  asm volatile(
      ".syntax unified\n\t"
      "mrs r1, msp\n\t"
      "movs r0, #0\n\t"
      "ldr r2, =stack_bottom\n\t"
      "cmp r1, r2\n\t"
      "bls 1f\n\t"
      "ldr r2, =stack_top - 32\n\t"
      "cmp r1, r2\n\t"
      "bhi 1f\n\t"
      "ldr r0, [r1, #24]\n"
      "1:\n\t"
      "ldr r2, =stack_top\n\t"
      "msr msp, r2\n\t"
      "bl take_exception\n\t"
      ".ltorg");
}

// `pc` is 0 where there was no frame.
extern "C" [[noreturn, gnu::used]] void take_exception(std::uint32_t pc) {
  using namespace striker::bare_metal;
  asm volatile("cpsid i" ::: "memory");
  std::uint32_t number = 0;
  asm volatile("mrs %0, ipsr" : "=r"(number));
  const FaultCause other = pc == 0 || !stack_is_intact() ? FaultCause::stack_overflow : FaultCause::exception;
  end_by_fault({.cause = watchdog_has_expired() ? FaultCause::watchdog : other,
                .exception = number,
                .status = fault_status(),
                .pc = pc});
}

namespace striker::bare_metal {

void reset_processor() {
  asm volatile("dsb" ::: "memory");
  *reinterpret_cast<volatile std::uint32_t*>(reset_control) = request_reset;
  for (;;) {
    asm volatile("dsb" ::: "memory");
  }
}

void stop_processor() {
  asm volatile("cpsid i" ::: "memory");
  for (;;) {
    asm volatile("wfi");
  }
}

}  // namespace striker::bare_metal

extern "C" [[gnu::weak]] void tick_interrupt() {}

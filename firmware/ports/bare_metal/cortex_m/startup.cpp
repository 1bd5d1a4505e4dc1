// SPDX-License-Identifier: Apache-2.0
// Reset and the vector table (Armv6-M to Armv8.1-M Architecture Reference Manuals, "Exception model").
#include <array>
#include <cstdint>

#include "firmware/ports/bare_metal/memory.hpp"

extern "C" {
extern std::uint32_t stack_top;
[[noreturn]] void reset();
[[noreturn]] void stop_on_exception();
void tick_interrupt();
int main();
}

namespace {

// A fault in the firmware itself: without a command the drives cut the torque within 10 ms.
using Handler = void (*)();

struct VectorTable {
  std::uint32_t* initial_stack;
  std::array<Handler, 15> handlers;
};

// Reset, NMI, HardFault, then the configurable faults, SVCall, debug monitor, PendSV, and SysTick last.
[[gnu::section(".vectors"), gnu::used]] const VectorTable vectors = {
    &stack_top,
    {reset, stop_on_exception, stop_on_exception, stop_on_exception, stop_on_exception, stop_on_exception,
     stop_on_exception, nullptr, nullptr, nullptr, stop_on_exception, stop_on_exception, nullptr,
     stop_on_exception, tick_interrupt}};

#ifdef __ARM_FP
constexpr std::uintptr_t coprocessor_access_control = 0xE000ED88;
constexpr std::uint32_t full_access_to_fpu = 0xFU << 20U;
#endif

}  // namespace

extern "C" void reset() {
#ifdef __ARM_FP
  // The FPU's registers, which are the vector unit's too, before the first instruction that names one.
  auto& access = *reinterpret_cast<volatile std::uint32_t*>(coprocessor_access_control);
  access = access | full_access_to_fpu;
  asm volatile("dsb\n\tisb" ::: "memory");
#endif
  striker::bare_metal::prepare_memory();
  main();
  stop_on_exception();
}

extern "C" [[gnu::weak]] void stop_on_exception() {
  for (;;) {
    asm volatile("wfi");
  }
}

extern "C" [[gnu::weak]] void tick_interrupt() {}

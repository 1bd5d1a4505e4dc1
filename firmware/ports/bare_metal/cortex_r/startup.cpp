// SPDX-License-Identifier: Apache-2.0
// Reset of the Cortex-R5F, which begins in Arm state; everything else is Thumb, as the kernel is.
//
// No interrupts: the port polls. An exception finds no vector table of its own here and stays in the
// memory's.
#include <cstdint>

#include "firmware/ports/bare_metal/memory.hpp"

extern "C" {
int main();
[[noreturn]] void start();
}

asm(".section .vectors, \"ax\"\n\t"
    ".arm\n\t"
    ".global reset\n\t"
    ".type reset, %function\n"
    "reset:\n\t"
    "ldr sp, =stack_top\n\t"
    "ldr r0, =start\n\t"
    "bx r0\n\t"
    ".ltorg\n\t"
    ".text\n\t"
    ".thumb\n\t");

extern "C" void start() {
  striker::bare_metal::prepare_memory();
  main();
  for (;;) {
    asm volatile("wfi");
  }
}

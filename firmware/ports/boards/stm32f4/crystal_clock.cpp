// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/boards/stm32f4/board_clock_tree.hpp"

extern "C" {
extern std::uint32_t flash_start;  // from the linker script: where the vector table is
}

// A boot loader leaves the vectors and the clocks at its own.
void striker::stm32f4::start_board_clock() {
  constexpr std::uint32_t vector_table_offset = 0xE000ED08;  // VTOR
  Memory::write(vector_table_offset, reinterpret_cast<std::uintptr_t>(&flash_start));
  Memory memory;
  if (!start_clock(memory, clock_tree)) {
    bare_metal::end_by_fault({.cause = bare_metal::FaultCause::clock});
  }
}

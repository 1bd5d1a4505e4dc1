// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/boards/stm32f4/board_clock_tree.hpp"

void striker::stm32f4::start_board_clock() {
  Memory memory;
  if (!start_clock(memory, clock_tree)) {
    bare_metal::end_by_fault({.cause = bare_metal::FaultCause::clock});
  }
}

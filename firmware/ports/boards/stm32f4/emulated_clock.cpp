// SPDX-License-Identifier: Apache-2.0
// QEMU 7.2's STM32F405 has no clock control: its registers read 0, and the processor has 168 MHz from the beginning.
#include "firmware/ports/boards/stm32f4/board_clock_tree.hpp"

void striker::stm32f4::start_board_clock() {}

// SPDX-License-Identifier: Apache-2.0
// The board's clocks, as its board.cmake gives them: STRIKER_CLOCK_HZ, STRIKER_CRYSTAL_HZ, STRIKER_CRYSTAL_IS_CLOCK.
#pragma once

#include "firmware/ports/boards/stm32f4/clock_tree.hpp"
#include "firmware/ports/boards/stm32f4/memory.hpp"

namespace striker::stm32f4 {

inline constexpr ClockTree clock_tree = {.crystal_hz = STRIKER_CRYSTAL_HZ,
                                         .crystal_is_clock = STRIKER_CRYSTAL_IS_CLOCK != 0,
                                         .system_hz = STRIKER_CLOCK_HZ};
static_assert(
    clock_tree.is_possible(),
    "STRIKER BOARD: no PLL setting makes CLOCK_HZ, 50 to 168 MHz, of STRIKER_CRYSTAL_HZ, 4 to 26 MHz");

// Once, before anything that needs the right time; ends in a fault if a clock does not start.
void start_board_clock();

}  // namespace striker::stm32f4

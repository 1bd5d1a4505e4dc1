# SPDX-License-Identifier: Apache-2.0
# firmware/ports/boards/zcu102-r5 with another clock: QEMU 7.2 emulates the triple timer counter of the Zynq-7000,
# with 16 bits where the UltraScale+ has 32. The processor's cycle counter runs at 1 GHz there.
include("${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/boards/zcu102-r5/board.cmake")
set(BOARD_NAME zcu102-r5-cycles)
set(BOARD_CLOCK_HZ 1000000000)
set(BOARD_CLOCK "${CMAKE_CURRENT_LIST_DIR}/cycle_clock.cpp")

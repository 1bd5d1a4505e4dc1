# SPDX-License-Identifier: Apache-2.0
# firmware/ports/boards/zcu102-r5 as a test wants it that breaks the processor: slcan over the first UART, since a kernel
# may have no CAN, and the processor's cycle counter as the clock, 1 GHz on QEMU, which stands still while a debugger looks.
cmake_path(SET BOARD_FOLDER NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/boards/zcu102-r5")
include("${BOARD_FOLDER}/board.cmake")
set(BOARD_FOLDER "${CMAKE_CURRENT_LIST_DIR}")
set(BOARD_NAME zcu102-r5-cycles)
set(BOARD_CLOCK_HZ 1000000000)
set(BOARD_CLOCK "${CMAKE_CURRENT_LIST_DIR}/cycle_clock.cpp")
set(BOARD_CAN "${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/bare_metal/slcan_bus.cpp")
set(BOARD_UART "${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/boards/zcu102-r5/cadence_uart.cpp")

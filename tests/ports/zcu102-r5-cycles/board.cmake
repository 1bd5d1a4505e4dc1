# SPDX-License-Identifier: Apache-2.0
# firmware/ports/boards/zcu102-r5 as a test wants it that breaks the processor: slcan over the first UART, since a kernel
# may have no CAN, and the processor's cycle counter as the clock, 1 GHz on QEMU, which stands still while a debugger looks.
include("${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/boards/zcu102-r5/board.cmake")
set(BOARD_NAME zcu102-r5-cycles)
set(BOARD_CLOCK_HZ 1000000000)
set(BOARD_CLOCK "${CMAKE_CURRENT_LIST_DIR}/cycle_clock.cpp")
set(BOARD_CAN "${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/bare_metal/slcan_bus.cpp")
set(BOARD_UART "${CMAKE_CURRENT_LIST_DIR}/../../../firmware/ports/boards/zcu102-r5/cadence_uart.cpp")

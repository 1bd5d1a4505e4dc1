# SPDX-License-Identifier: Apache-2.0
# Arm's MPS2+ board with the FPGA image of Application Note AN505, in secure state, as it comes out of reset.
striker_add_board(
  NAME mps2-an505
  CPU cortex-m33
  LABEL Cortex-M33
  FLASH_ORIGIN 0x10000000
  FLASH 4M
  RAM_ORIGIN 0x38000000
  RAM 4M
  CLOCK_HZ 20000000
  INTERRUPTS 124
  SOURCES cortex_m/startup.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN slcan
  UART devices/cmsdk_uart.cpp
  WATCHDOG devices/cmsdk_watchdog.cpp
  DEFINITIONS STRIKER_UART=0x50200000 STRIKER_WATCHDOG=0x50081000 STRIKER_WATCHDOG_HZ=20000000
  QEMU_MACHINE mps2-an505)

# SPDX-License-Identifier: Apache-2.0
# Arm's MPS2 board with the FPGA image of Application Note AN385.
striker_add_board(
  NAME mps2-an385
  CPU cortex-m3
  LABEL Cortex-M3
  FLASH_ORIGIN 0x00000000
  FLASH 4M
  RAM_ORIGIN 0x20000000
  RAM 4M
  CLOCK_HZ 25000000
  INTERRUPTS 32
  SOURCES cortex_m/startup.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN slcan
  UART devices/cmsdk_uart.cpp
  WATCHDOG devices/cmsdk_watchdog.cpp
  DEFINITIONS STRIKER_UART=0x40004000 STRIKER_WATCHDOG=0x40008000 STRIKER_WATCHDOG_HZ=25000000
  QEMU_MACHINE mps2-an385)

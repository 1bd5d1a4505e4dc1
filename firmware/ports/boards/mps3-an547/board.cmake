# SPDX-License-Identifier: Apache-2.0
# Arm's MPS3 board with the FPGA image of Application Note AN547, in secure state, as it comes out of reset.
striker_add_board(
  NAME mps3-an547
  CPU cortex-m55
  LABEL Cortex-M55
  FLASH_ORIGIN 0x10000000
  FLASH 512K
  RAM_ORIGIN 0x30000000
  RAM 512K
  CLOCK_HZ 32000000
  INTERRUPTS 128
  SOURCES cortex_m/startup.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN slcan
  UART devices/cmsdk_uart.cpp
  WATCHDOG devices/cmsdk_watchdog.cpp
  DEFINITIONS STRIKER_UART=0x59303000 STRIKER_WATCHDOG=0x5802E000 STRIKER_WATCHDOG_HZ=32000
  QEMU_MACHINE mps3-an547)

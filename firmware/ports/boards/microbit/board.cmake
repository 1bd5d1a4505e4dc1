# SPDX-License-Identifier: Apache-2.0
# The BBC micro:bit, whose nRF51 is a Cortex-M0: the Cortex-M0+'s instruction set.
striker_add_board(
  NAME microbit
  CPU cortex-m0plus
  LABEL Cortex-M0+
  FLASH_ORIGIN 0x00000000
  FLASH 256K
  RAM_ORIGIN 0x20000000
  RAM 16K
  CLOCK_HZ 16000000
  INTERRUPTS 32
  SOURCES cortex_m/startup.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN slcan
  UART nrf_uart.cpp
  WATCHDOG nrf_watchdog.cpp
  QEMU_MACHINE microbit)

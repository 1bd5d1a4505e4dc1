# SPDX-License-Identifier: Apache-2.0
# firmware/ports/boards/zcu102-r5 with another clock: QEMU 7.2 emulates the triple timer counter of the Zynq-7000, with 16
# bits where the UltraScale+ has 32. The processor's cycle counter runs at 1 GHz there.
striker_add_board(
  NAME zcu102-r5-cycles
  CPU cortex-r5
  LABEL Cortex-R5F
  FLASH_ORIGIN 0xFFFC0000
  FLASH 192K
  RAM_ORIGIN 0xFFFF8000
  RAM 31K
  CLOCK_HZ 1000000000
  INTERRUPTS 0
  SOURCES cortex_r/startup.cpp cortex_r/no_reset.cpp
  CLOCK cycle_clock.cpp
  CAN slcan
  UART ../../../firmware/ports/boards/zcu102-r5/cadence_uart.cpp
  WATCHDOG none)

# SPDX-License-Identifier: Apache-2.0
# QEMU's Netduino Plus 2: an STM32F405 without clock control, CAN and watchdog. ../stm32f4/README.md says what that leaves.
striker_add_board(
  NAME netduinoplus2
  CPU cortex-m4
  LABEL STM32F405
  FLASH_ORIGIN 0x08000000
  FLASH 1M
  RAM_ORIGIN 0x20000000
  RAM 128K
  CLOCK_HZ 168000000
  INTERRUPTS 82
  SOURCES cortex_m/startup.cpp ../stm32f4/emulated_clock.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN slcan
  UART ../stm32f4/usart.cpp
  WATCHDOG ../stm32f4/independent_watchdog.cpp
  DEFINITIONS STRIKER_CRYSTAL_HZ=25000000 STRIKER_CRYSTAL_IS_CLOCK=0
  QEMU_MACHINE netduinoplus2)

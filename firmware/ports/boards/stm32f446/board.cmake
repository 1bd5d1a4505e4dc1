# SPDX-License-Identifier: Apache-2.0
# ST's STM32F446: see ../stm32f4/README.md. It has not run on silicon.
striker_add_board(
  NAME stm32f446
  CPU cortex-m4
  LABEL STM32F446
  FLASH_ORIGIN 0x08000000
  FLASH 512K
  RAM_ORIGIN 0x20000000
  RAM 128K
  IMAGE_FLASH 52K
  IMAGE_RAM 5K
  CLOCK_HZ 160000000
  INTERRUPTS 97
  HANDLERS 20=can1_reception
  SOURCES cortex_m/startup.cpp ../stm32f4/crystal_clock.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN ../stm32f4/can.cpp
  WATCHDOG ../stm32f4/independent_watchdog.cpp
  DEFINITIONS STRIKER_CRYSTAL_HZ=8000000 STRIKER_CRYSTAL_IS_CLOCK=1)

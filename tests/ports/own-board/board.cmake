# SPDX-License-Identifier: Apache-2.0
# A board outside firmware/ports/boards, with a CAN driver and an interrupt of its own: Arm's MPS2 with AN386, so that QEMU
# runs it, which has no CAN controller for it. -DSTRIKER_BOARD_DIR names this folder.
striker_add_board(
  NAME own-board
  CPU cortex-m4
  FLASH_ORIGIN 0x00000000
  FLASH 4M
  RAM_ORIGIN 0x20000000
  RAM 4M
  IMAGE_RAM 5K
  CLOCK_HZ 25000000
  INTERRUPTS 32
  HANDLERS 0=own_letter_received
  SOURCES cortex_m/startup.cpp
  CLOCK cortex_m/systick_clock.cpp
  CAN own_can.cpp
  WATCHDOG devices/cmsdk_watchdog.cpp
  DEFINITIONS OWN_PORT=0x40004000 STRIKER_WATCHDOG=0x40008000 STRIKER_WATCHDOG_HZ=25000000
  QEMU_MACHINE mps2-an386)

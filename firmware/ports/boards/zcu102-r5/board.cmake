# SPDX-License-Identifier: Apache-2.0
# AMD's ZCU102: the Zynq UltraScale+ MPSoC's first Cortex-R5F, with the on-chip memory for everything: the
# image, the exceptions' vectors where the core looks for them, at 0xFFFF0000, and the RAM 32 KB above. The timer counts the
# low-power domain's 100 MHz. The R5 cannot reset itself without the whole chip, which would take the RAM with the fault's
# record. QEMU 7.2 has the R5 as its fifth processor, and leaves it switched off.
striker_add_board(
  NAME zcu102-r5
  CPU cortex-r5
  LABEL Cortex-R5F
  FLASH_ORIGIN 0xFFFC0000
  FLASH 192K
  RAM_ORIGIN 0xFFFF8000
  RAM 31K
  IMAGE_FLASH 52K
  IMAGE_RAM 4608
  CLOCK_HZ 100000000
  INTERRUPTS 0
  SOURCES cortex_r/startup.cpp cortex_r/no_reset.cpp
  CLOCK ttc_clock.cpp
  CAN zynqmp_can.cpp
  WATCHDOG swdt_watchdog.cpp
  DEFINITIONS STRIKER_CAN_CLOCK_HZ=100000000 STRIKER_WATCHDOG_CLOCK_HZ=100000000
  QEMU_MACHINE xlnx-zcu102
  QEMU_SYSTEM qemu-system-aarch64
  QEMU_ARGUMENTS -smp 5 -m 128M -audiodev none,id=a -S -global xlnx-zynqmp.boot-cpu=rpu-cpu[0]
                 -device loader,file={image},cpu-num=4
  QEMU_POWER_ON /machine/soc/rpu-cluster/rpu-cpu[0]
  QEMU_CAN canbus0
  QEMU_CLOCK_HZ 133000000
  QEMU_DEFINITIONS STRIKER_CAN_WORDS_OF_QEMU=1)

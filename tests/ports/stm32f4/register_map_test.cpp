// SPDX-License-Identifier: Apache-2.0
// The registers' addresses and bits as RM0090's register maps list them: driver and model share the names, and would be
// wrong alike.
#include <gtest/gtest.h>

#include "firmware/ports/boards/stm32f4/bxcan_registers.hpp"
#include "firmware/ports/boards/stm32f4/clock_tree.hpp"
#include "firmware/ports/boards/stm32f4/independent_watchdog.hpp"

namespace striker::stm32f4 {

namespace {

TEST(Stm32f4Registers, CanIsAsTheManualHasIt) {
  EXPECT_EQ(can1::control, 0x40006400U);
  EXPECT_EQ(can1::status, 0x40006404U);
  EXPECT_EQ(can1::transmit_status, 0x40006408U);
  EXPECT_EQ(can1::receive_fifo, 0x4000640CU);
  EXPECT_EQ(can1::interrupts, 0x40006414U);
  EXPECT_EQ(can1::errors, 0x40006418U);
  EXPECT_EQ(can1::timing, 0x4000641CU);
  EXPECT_EQ(can1::transmit_mailbox(0), 0x40006580U);
  EXPECT_EQ(can1::transmit_mailbox(2), 0x400065A0U);
  EXPECT_EQ(can1::receive_mailbox, 0x400065B0U);
  EXPECT_EQ(can1::filter_control, 0x40006600U);
  EXPECT_EQ(can1::filter_is_list, 0x40006604U);
  EXPECT_EQ(can1::filter_is_32_bits, 0x4000660CU);
  EXPECT_EQ(can1::filter_to_fifo_1, 0x40006614U);
  EXPECT_EQ(can1::filter_is_on, 0x4000661CU);
  EXPECT_EQ(can1::filter_bank(13) + 4, 0x400066ACU);
  // RQCP, TXOK, ABRQ and TME of the last mailbox; EPVF and BOFF; FMP and RFOM; RFLM.
  EXPECT_EQ(can1::completed(2) | can1::was_sent(2) | can1::take_back(2) | can1::is_empty(2), 0x10830000U);
  EXPECT_EQ(can1::error_passive, 1U << 1U);
  EXPECT_EQ(can1::bus_off, 1U << 2U);
  EXPECT_EQ(can1::frames_pending | can1::release, 0x23U);
  EXPECT_EQ(can1::receive_locked | can1::initialise | can1::sleep, 0xBU);
}

TEST(Stm32f4Registers, ClocksFlashAndWatchdogAreAsTheManualHasThem) {
  EXPECT_EQ(rcc::control, 0x40023800U);
  EXPECT_EQ(rcc::pll, 0x40023804U);
  EXPECT_EQ(rcc::configuration, 0x40023808U);
  EXPECT_EQ(rcc::reset_apb1, 0x40023820U);
  EXPECT_EQ(rcc::enable_ahb1, 0x40023830U);
  EXPECT_EQ(rcc::enable_apb1, 0x40023840U);
  EXPECT_EQ(rcc::enable_apb2, 0x40023844U);
  EXPECT_EQ(rcc::control_status, 0x40023874U);
  EXPECT_EQ(clock_bits::flash_access, 0x40023C00U);
  EXPECT_EQ(clock_bits::prescalers, 0xF0U | 7U << 10U | 7U << 13U);
  EXPECT_EQ(iwdg::key, 0x40003000U);
  EXPECT_EQ(iwdg::status, 0x4000300CU);
  EXPECT_EQ(gpio::port_a, 0x40020000U);
  EXPECT_EQ(gpio::port_b, 0x40020400U);
}

}  // namespace

}  // namespace striker::stm32f4

// SPDX-License-Identifier: Apache-2.0
// The numbers that the Zynq UltraScale+'s watchdog takes.
#include <gtest/gtest.h>

#include "firmware/ports/bare_metal/watchdog.hpp"
#include "firmware/ports/boards/zcu102-r5/swdt.hpp"

namespace striker::zcu102 {

namespace {

TEST(Swdt, ItsTimeOutIsWhatABoardHasToKeep) {
  for (const std::uint32_t clock_hz : {99'000'000U, 100'000'000U, 50'000'000U}) {
    const std::uint32_t control = swdt_control(clock_hz, bare_metal::watchdog_timeout_ms);
    EXPECT_GE(swdt_timeout_us(control, clock_hz), 1'000 * bare_metal::watchdog_timeout_ms);
    EXPECT_LE(swdt_timeout_us(control, clock_hz), 30'000U);
  }
}

// AMD UG1087: control's key 0x248 in bits 14 to 25, reload value in 2 to 13; mode's key 0xABC in bits 12 to 23.
TEST(Swdt, ItsWordsHaveTheirKeys) {
  EXPECT_EQ(swdt_control(100'000'000, 20), 0x00920000U | 61U << 2U);
  EXPECT_EQ(swdt_run, 0x00ABC1C3U);
}

}  // namespace

}  // namespace striker::zcu102

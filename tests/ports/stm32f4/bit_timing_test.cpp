// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/boards/stm32f4/bit_timing.hpp"

#include <gtest/gtest.h>

namespace striker::stm32f4 {

namespace {

constexpr std::uint32_t bit_rate = 1'000'000;

// The register's value worked out by hand: 20 quanta of 2 clocks, 14 before the sample point, 5 after it, jump 4.
static_assert(bit_timing(40'000'000, bit_rate).register_value() == 0x034D0001);
static_assert(bit_timing(40'000'000, bit_rate).sample_point_permille() == 750);
static_assert(bit_timing(42'000'000, bit_rate).sample_point_permille() == 761);
static_assert(bit_timing(41'500'000, bit_rate).prescaler == 0, "no whole quanta");
static_assert(bit_timing(7'000'000, bit_rate).prescaler == 0, "too few quanta");

TEST(BxCanBitTiming, IsExactNear75PercentAndFitsTheRegisterOrIsNone) {
  int found = 0;
  for (std::uint32_t clock_hz = 1'000'000; clock_hz <= 45'000'000; clock_hz += 250'000) {
    const BitTiming timing = bit_timing(clock_hz, bit_rate);
    if (timing.prescaler == 0) {
      continue;
    }
    ++found;
    EXPECT_EQ(timing.prescaler * timing.quanta() * bit_rate, clock_hz);
    EXPECT_NEAR(timing.sample_point_permille(), 750, 25) << clock_hz;
    EXPECT_TRUE(timing.prescaler <= 1024 && timing.before >= 1 && timing.before <= 16) << clock_hz;
    EXPECT_TRUE(timing.after >= 1 && timing.after <= 8 && timing.jump <= timing.after && timing.jump <= 4)
        << clock_hz;
  }
  EXPECT_GT(found, 10);
}

}  // namespace

}  // namespace striker::stm32f4

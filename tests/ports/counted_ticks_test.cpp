// SPDX-License-Identifier: Apache-2.0
// Ticks from a counter of any width: as many as have passed, over every wrap and every restart.
#include <gtest/gtest.h>

#include "firmware/ports/boards/zcu102-r5/counted_ticks.hpp"

namespace striker::zcu102 {

namespace {

// A counter that is asked every `step` counts, as a loop does that polls.
void expect_right_ticks(std::uint32_t mask, std::uint32_t counts_a_tick, std::uint32_t step, bool restarts) {
  std::uint64_t passed = 0xFFFFFF00;
  std::uint64_t began_at = 0;
  const std::uint64_t first = passed;
  CountedTicks counted(mask, counts_a_tick, static_cast<std::uint32_t>(passed) & mask);
  for (int i = 0; i < 100'000; ++i) {
    passed += step;
    const auto count = static_cast<std::uint32_t>(passed - began_at) & mask;
    ASSERT_EQ(counted.ticks(count), static_cast<std::uint32_t>((passed - first) / counts_a_tick))
        << "at count " << count;
    ASSERT_EQ(counted.since_tick_us(count), (passed - first) % counts_a_tick * 1'000 / counts_a_tick);
    if (restarts && counted.is_due_to_restart(count)) {
      counted.restart(count);
      began_at = passed;
    }
  }
}

TEST(CountedTicks, AreRightForEveryWidth) {
  for (const std::uint32_t step : {1U, 611U, 16'625U, 30'000U}) {
    expect_right_ticks(0xFFFF, 16'625, step, false);
    expect_right_ticks(0xFFFFFFFF, 12'500, step, false);
  }
}

TEST(CountedTicks, AreRightOverRestarts) {
  for (const std::uint32_t step : {1U, 611U, 16'625U, 30'000U}) {
    expect_right_ticks(0xFFFF, 16'625, step, true);
    expect_right_ticks(0xFFFFFFFF, 12'500, step, true);
  }
}

// The fault that this board once had: time jumped by 43 s at the first wrap of a counter narrower than thought.
TEST(CountedTicks, TheFirstWrapOfANarrowCounterIsNoJump) {
  CountedTicks counted(0xFFFF, 16'625, 0);
  EXPECT_EQ(counted.ticks(0xFFFF), 3U);
  EXPECT_EQ(counted.ticks(0x0001), 3U);
  EXPECT_EQ(counted.ticks(0x03E4), 4U);
}

}  // namespace

}  // namespace striker::zcu102

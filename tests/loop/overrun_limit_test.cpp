// SPDX-License-Identifier: Apache-2.0
// The overrun rule against a plain count over the ticks themselves.
#include "firmware/loop/overrun_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>
#include <vector>

namespace striker::loop {
namespace {

TEST(OverrunLimit, OneMissedTickCountsForTheWindowAndNoLonger) {
  OverrunLimit none(0);
  EXPECT_FALSE(none.exceeded_by(0));
  EXPECT_TRUE(none.exceeded_by(1));
  for (std::uint32_t tick = 4; tick <= 1000; ++tick) {
    ASSERT_TRUE(none.exceeded_by(0)) << tick;
  }
  EXPECT_FALSE(none.exceeded_by(0));
}

TEST(OverrunLimit, AStallLongerThanTheWindowFillsIt) {
  OverrunLimit most(899);
  EXPECT_TRUE(most.exceeded_by(50'000));
  OverrunLimit all(OverrunLimit::window_ticks);
  EXPECT_FALSE(all.exceeded_by(4'000'000'000));
}

// Never fewer than the missed ticks of the last 901, never more than those of the last 1,000.
TEST(OverrunLimit, LiesBetweenTheShortestAndTheLongestWindow) {
  std::mt19937 random(1);
  std::uint32_t tick = 0;
  std::deque<std::uint32_t> missed_ticks;
  std::vector<OverrunLimit> limits;
  for (std::uint32_t limit = 0; limit < 1000; ++limit) {
    limits.emplace_back(limit);
  }
  for (int wake = 0; wake < 3000; ++wake) {
    const std::uint32_t missed = random() % 50 == 0 ? static_cast<std::uint32_t>(random() % 120) : 0;
    for (std::uint32_t i = 1; i <= missed; ++i) {
      missed_ticks.push_back(tick + i);
    }
    tick += missed + 1;
    const auto within = [&](std::uint32_t window) {
      return static_cast<std::uint32_t>(std::count_if(missed_ticks.begin(), missed_ticks.end(),
                                                      [&](std::uint32_t t) { return tick - t < window; }));
    };
    std::uint32_t counted = 0;
    for (OverrunLimit& limit : limits) {
      counted += limit.exceeded_by(missed) ? 1 : 0;
    }
    ASSERT_GE(counted, within(901)) << tick;
    ASSERT_LE(counted, within(1000)) << tick;
  }
}

}  // namespace
}  // namespace striker::loop

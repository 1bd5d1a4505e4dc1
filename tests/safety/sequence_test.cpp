// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/sequence.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace striker::safety {
namespace {

// Takes these steps of the counter, one a tick, after the counter 0 at tick 0. A step of 16 is a wrong frame.
bool is_fresh_after(const std::vector<std::uint32_t>& steps) {
  Sequence<3, 3> sequence;
  std::uint32_t counter = 0;
  std::uint32_t tick = 0;
  sequence.take(0, tick);
  for (const std::uint32_t step : steps) {
    ++tick;
    if (step == 16) {
      sequence.take(std::nullopt, tick);
    } else {
      counter = (counter + step) % 16;
      sequence.take(static_cast<std::uint8_t>(counter), tick);
    }
  }
  return sequence.fresh(tick, 0);
}

TEST(Sequence, IsFreshAfterAStreakOfSmallSteps) {
  EXPECT_FALSE(is_fresh_after({}));
  EXPECT_FALSE(is_fresh_after({1, 1}));
  EXPECT_TRUE(is_fresh_after({1, 1, 1}));
  EXPECT_TRUE(is_fresh_after({3, 1, 1})) << "two missing at once";
  EXPECT_TRUE(is_fresh_after({2, 2, 2, 2})) << "each streak has an account of its own";
  EXPECT_TRUE(is_fresh_after({2, 2, 2, 2, 2, 2, 2}));
  EXPECT_FALSE(is_fresh_after({3, 3, 3, 3, 3, 3, 3})) << "two of three are missing";
}

TEST(Sequence, ARepeatedAJumpingOrAWrongFrameBreaksTheStreak) {
  for (const std::uint32_t breaking : {0U, 4U, 15U, 16U}) {
    EXPECT_FALSE(is_fresh_after({1, 1, 1, 1, 1, breaking})) << breaking;
    EXPECT_FALSE(is_fresh_after({1, 1, 1, 1, 1, breaking, 1, 1})) << breaking;
    EXPECT_FALSE(is_fresh_after({1, 1, 1, 2, breaking})) << breaking << " where one is missing";
    EXPECT_TRUE(is_fresh_after({1, 1, 1, 1, 1, breaking, 1, 1, 1})) << breaking;
  }
}

TEST(Sequence, AWrongFrameDoesNotMoveTheCounter) {
  Sequence<1, 3> sequence;
  sequence.take(0, 0);
  sequence.take(5, 1);
  sequence.take(std::nullopt, 2);
  sequence.take(6, 3);
  EXPECT_TRUE(sequence.fresh(3, 0));
}

TEST(Sequence, FreshLastsItsLimitFromWhenItWasReceived) {
  Sequence<1, 3> sequence;
  EXPECT_FALSE(sequence.fresh(0, 1000)) << "nothing came";
  sequence.take(0, 10);
  sequence.take(1, 11);
  EXPECT_TRUE(sequence.fresh(36, 25));
  EXPECT_FALSE(sequence.fresh(37, 25));
}

// Every set of so few counters, in rising order, for ever: by count, not by the rule.
TEST(Sequence, NoSetOfElevenOldFramesOrFewerStaysFresh) {
  for (std::uint32_t set = 1; set < 1U << 16U; ++set) {
    if (std::popcount(set) > 11) {
      continue;
    }
    Sequence<12, 4> sequence;
    std::uint32_t tick = 0;
    for (int i = 0; i < 40; ++i) {
      sequence.take(static_cast<std::uint8_t>(i % 16), ++tick);
    }
    ASSERT_TRUE(sequence.fresh(tick, 0));
    std::uint32_t last_fresh = tick;
    const std::uint32_t begin = tick;
    for (int round = 0; round < 8; ++round) {
      for (std::uint8_t counter = 0; counter < 16; ++counter) {
        if ((set >> counter & 1U) != 0) {
          sequence.take(counter, ++tick);
          last_fresh = sequence.fresh(tick, 0) ? tick : last_fresh;
        }
      }
    }
    ASSERT_LE(last_fresh - begin, 24U) << set;
  }
}

}  // namespace
}  // namespace striker::safety

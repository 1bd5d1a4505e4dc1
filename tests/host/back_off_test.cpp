// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/back_off.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace striker::host {
namespace {

using std::chrono::milliseconds;

TEST(BackOff, TriesAtOnceThenAfterPausesThatDoubleUpToASecond) {
  BackOff back_off;
  std::vector<int> tries_ms;
  for (int at_ms = 0; at_ms <= 4'000; at_ms += 10) {
    if (back_off.due(BackOff::Time(std::chrono::hours(1) + milliseconds(at_ms)))) {
      tries_ms.push_back(at_ms);
    }
  }
  EXPECT_EQ(tries_ms, (std::vector<int>{0, 100, 300, 700, 1500, 2500, 3500}));
}

TEST(BackOff, BeginsAnewAfterASuccess) {
  BackOff back_off;
  const BackOff::Time now(std::chrono::hours(1));
  EXPECT_TRUE(back_off.due(now));
  EXPECT_FALSE(back_off.due(now));
  back_off.reset();
  EXPECT_TRUE(back_off.due(now));
  EXPECT_TRUE(back_off.due(now + milliseconds(100)));
}

}  // namespace
}  // namespace striker::host

// SPDX-License-Identifier: Apache-2.0
// The pause after bus-off: never shorter than ISO 11898-1 wants, longer each time, short again after a good second.
#include <gtest/gtest.h>

#include <vector>

#include "firmware/ports/bare_metal/can_driver/bus_off_pause.hpp"

namespace striker::bare_metal {

namespace {

// Ticks until it may come back.
std::uint32_t length(BusOffPause& pause, std::uint32_t& tick) {
  const std::uint32_t begin = tick;
  pause.begin(tick);
  while (!pause.is_over(tick)) {
    ++tick;
  }
  return tick - begin;
}

TEST(BusOffPause, DoublesWhileItGoesOffAgainAtOnce) {
  BusOffPause pause;
  std::uint32_t tick = 0xFFFFFFF0;  // over the clock's wrap
  std::vector<std::uint32_t> lengths;
  for (int i = 0; i < 9; ++i) {
    lengths.push_back(length(pause, tick));
    tick += 5;
  }
  EXPECT_EQ(lengths, (std::vector<std::uint32_t>{3, 5, 9, 17, 33, 65, 129, 129, 129}));
  EXPECT_EQ(pause.times(), 9U);
}

TEST(BusOffPause, IsShortAgainAfterASecondOnTheBus) {
  BusOffPause pause;
  std::uint32_t tick = 0;
  length(pause, tick);
  EXPECT_EQ(length(pause, tick), 5U);
  tick += BusOffPause::forgotten_after_ticks;
  EXPECT_EQ(length(pause, tick), 3U);
}

}  // namespace

}  // namespace striker::bare_metal

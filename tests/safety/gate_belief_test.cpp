// SPDX-License-Identifier: Apache-2.0
// What the gate believes of a message: how many frames in a row, how many may be lost, and that no recording passes.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "tests/safety/gate_fixture.hpp"

namespace striker::safety {
namespace {

class GateBeliefs : public GateRules {};

// A dozen steps of the wheel states' counter, three of a picture's: no fewer, and no more.
class GateBelief : public GateRules, public testing::WithParamInterface<int> {};
TEST_P(GateBelief, NeedsItsStreak) {
  bool& sends =
      *std::array{&sends_wheels, &sends_poses, &sends_balls}.at(static_cast<std::size_t>(GetParam()));
  sends = false;
  feed(20);
  sends = true;
  feed(GetParam() == 0 ? 12 : 3);
  confirm(arm);
  EXPECT_FALSE(moves());
  confirm(clear);
  feed();
  confirm(arm);
  EXPECT_TRUE(moves());
}
INSTANTIATE_TEST_SUITE_P(WheelsPosesBalls, GateBelief, testing::Values(0, 1, 2));

TEST_F(GateBeliefs, AQuarterOfTheWheelStatesMayBeLost) {
  drive();
  for (std::uint32_t i = 0; i < 200; ++i) {
    if (i % 3 == 0) {
      lose_wheels();
    }
    feed();
    EXPECT_TRUE(moves()) << i;
  }
}

// Counters 0, 2, 4, 6, 8 and 10 to 15 again and again, so that they go on from the true ones: recorded frames, of which no
// eleven may pass for a sender's.
TEST_F(GateBeliefs, ElevenOldWheelStatesAreNoneHoweverTheyRepeat) {
  drive();
  std::array<can::Frame, 16> old;
  can::SendCounter counter;
  for (can::Frame& frame : old) {
    frame = can::send(can::WheelState{}, counter);
  }
  sends_wheels = false;
  for (std::uint32_t i = 0; i < 200; ++i) {
    constexpr std::array<std::size_t, 11> kept = {13, 14, 15, 0, 2, 4, 6, 8, 10, 11, 12};
    receive(old.at(kept.at(i % kept.size())));
    feed();
    EXPECT_TRUE(i < 50 || !moves()) << i;
  }
}

TEST_F(GateBeliefs, HalfOfThePicturesMayBeLostAndNoMore) {
  for (const auto lose : {&GateBeliefs_HalfOfThePicturesMayBeLostAndNoMore_Test::lose_pose,
                          &GateBeliefs_HalfOfThePicturesMayBeLostAndNoMore_Test::lose_ball}) {
    confirm(clear);
    drive();
    for (std::uint32_t i = 0; i < 450; ++i) {
      (this->*lose)();
      feed();
      EXPECT_TRUE(moves()) << i;
    }
    for (std::uint32_t i = 0; i < 450; ++i) {
      (this->*lose)();
      if (i % 3 == 0) {
        (this->*lose)();
      }
      feed();
      EXPECT_TRUE(i < 210 || !moves()) << i;
    }
  }
}

// Steps of the operator's counter: how many of his frames there were for each that came. What came before does not count,
// as the arming's frame comes twice.
TEST_F(GateBeliefs, ThreeRenewalsInARowRenewAndHalfOfThemMayBeLost) {
  for (const auto& [steps, renews] : {std::pair{std::vector{1, 1}, false},
                                      {std::vector{1, 1, 1}, true},
                                      {std::vector{2, 2, 2}, true},
                                      {std::vector{3, 2, 2}, false}}) {
    confirm(clear);
    drive();
    repeat_order();
    feed(5'000);
    for (const int step : steps) {
      for (int lost = 1; lost < step; ++lost) {
        lose_order();
      }
      order(renew, 0);
    }
    feed(5'200);
    EXPECT_EQ(moves(), renews) << steps.size() << ' ' << steps.front();
  }
}

}  // namespace
}  // namespace striker::safety

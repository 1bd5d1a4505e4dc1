// SPDX-License-Identifier: Apache-2.0
// Ordered kicks, as match_figures.hpp has them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/match/record/recorded_match.hpp"

namespace striker::sil {
namespace {

struct Kicking : RecordedMatch {
  Kicking() {
    open_play();
    ball(0.5, 1.0);
    step();
  }
  // In each frame from now on red's robot 3 is ordered to kick to the opponent's goal.
  void order_kick(std::uint8_t number) {
    orders[0] = TeamOrders{};
    (*orders[0])[3] = MotionOrder{.number = number, .target = {3.9, 1.0, 0.0}};
  }
  void order_speed() { (*orders[0])[3] = SpeedOrder{1.0, 1.0}; }
  // It is met, and has gone this way 100 ms later.
  void meet(double direction_deg) {
    touched_by({red(3)});
    const double angle = direction_deg * std::numbers::pi / 180.0;
    ball(0.5 + 0.4 * std::cos(angle), 1.0 + 0.4 * std::sin(angle));
    run(100);
  }
  const TeamFigures& red_figures() const { return figures(Team::red); }
};

TEST(KickCounts, CountOnceForEachNumber) {
  Kicking play;
  play.order_kick(1);
  play.run(500);
  EXPECT_EQ(play.red_figures().kicks, 1);
  play.order_kick(2);
  play.run(500);
  EXPECT_EQ(play.red_figures().kicks, 2);
  EXPECT_EQ(play.red_figures().kicks_met, 0);
  EXPECT_EQ(play.figures(Team::blue).kicks, 0);
}

TEST(KickCounts, AreAsMeantWithin15Degrees) {
  for (const double beside_deg : {-16.0, -14.0, 0.0, 14.0, 16.0}) {
    Kicking play;
    play.order_kick(1);
    play.run(100);
    play.meet(beside_deg);
    EXPECT_EQ(play.red_figures().kicks_met, 1);
    EXPECT_EQ(play.red_figures().kicks_as_meant, std::abs(beside_deg) < 15.0 ? 1 : 0) << beside_deg;
  }
}

TEST(KickCounts, ATouchCountsOnceAndOnlyWhileTheMotionGoesOn) {
  Kicking play;
  play.order_kick(1);
  play.run(100);
  play.meet(0.0);
  play.touched_by({red(3)});
  EXPECT_EQ(play.red_figures().kicks_met, 1);
  play.order_speed();
  play.run(100);
  play.touched_by({red(3)});
  EXPECT_EQ(play.red_figures().kicks_met, 1);
}

TEST(KickCounts, AnotherRobotsTouchIsNone) {
  Kicking play;
  play.order_kick(1);
  play.run(100);
  play.touched_by({red(4)});
  EXPECT_EQ(play.red_figures().kicks_met, 0);
}

TEST(KickCounts, BlueMeansTheOtherGoal) {
  Kicking play;
  play.orders[1] = TeamOrders{};
  (*play.orders[1])[3] = MotionOrder{.number = 1, .target = {3.9, -1.0, 0.0}};
  play.run(100);
  play.touched_by({blue(3)});
  play.ball(0.1, 1.0);
  play.run(100);
  EXPECT_EQ(play.figures(Team::blue).kicks_as_meant, 1);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// The estimator on ideal pictures: exact velocities, lead between pictures, and nothing kept after a reset.
#include "firmware/core/estimation/estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace striker::core {
namespace {

constexpr RobotProfile profile = profile_of(forward);

// An estimator with the odometry that belongs to it.
struct Bench {
  Estimator estimator;
  Odometry odometry;
  RobotProfile told = profile;

  PictureResult end_tick(std::uint32_t tick) {
    odometry.advance(told, tick);
    return estimator.end_tick(told, odometry);
  }
  [[nodiscard]] Estimate at(std::uint32_t tick) const { return estimator.at(tick, odometry); }

  // A picture of a ball that moves 3 counts along x and -2 along y a frame.
  PictureResult show(std::int32_t number, std::uint32_t tick, RobotSighting robot = {}) {
    robot.picture = number % 16;
    estimator.take(robot, tick);
    estimator.take(BallSighting{.picture = number % 16,
                                .position_um = {250 * (4000 + 300 * number), 250 * -200 * number}},
                   tick);
    return end_tick(tick);
  }
};

TEST(Estimator, VelocityIsTheDifferenceOfTheLastTwoPictures) {
  Bench bench;
  EXPECT_EQ(bench.show(0, 0), PictureResult::taken);
  EXPECT_FALSE(bench.estimator.has_velocity());
  EXPECT_EQ(bench.show(1, 50), PictureResult::taken);
  ASSERT_TRUE(bench.estimator.has_velocity());
  const Estimate estimate = bench.at(50);
  EXPECT_EQ(estimate.ball_um.x, 4300 * 250);
  EXPECT_EQ(estimate.ball_velocity_mm_s.x, 1500);  // 300 counts of 0.25 mm in 50 ms
  EXPECT_EQ(estimate.ball_velocity_mm_s.y, -1000);
}

TEST(Estimator, LostPicturesAreCountedByTheirNumbersWhereTheTimeAgrees) {
  for (std::int32_t step = 1; step <= 3; ++step) {
    Bench bench;
    bench.show(14, 0);
    EXPECT_EQ(bench.show(14 + step, static_cast<std::uint32_t>(50 * step)), PictureResult::taken) << step;
    ASSERT_TRUE(bench.estimator.has_velocity());
    EXPECT_EQ(bench.at(static_cast<std::uint32_t>(50 * step)).ball_velocity_mm_s.x, 1500) << step;
  }
}

TEST(Estimator, ANumberThatDoesNotFitTheTimeIsNoPicture) {
  for (std::int32_t step = 2; step <= 15; ++step) {
    Bench bench;
    bench.show(0, 0);
    EXPECT_EQ(bench.show(step, 50), PictureResult::implausible) << step;
    EXPECT_FALSE(bench.estimator.has_velocity());
  }
  Bench bench;
  bench.show(0, 0);
  EXPECT_EQ(bench.show(16, 50), PictureResult::none) << "a repeated number is the same picture";
}

// A camera that was away comes back with one picture, whatever its number says: no velocity yet.
TEST(Estimator, AfterALongGapOnePictureIsNotEnoughForAVelocity) {
  for (std::int32_t gap = 4; gap < 164; ++gap) {
    Bench bench;
    bench.show(0, 0);
    bench.show(1, 50);
    const auto back = static_cast<std::uint32_t>(50 + 50 * gap);
    EXPECT_EQ(bench.show(1 + gap, back), PictureResult::taken) << gap;
    EXPECT_FALSE(bench.estimator.has_velocity()) << gap;
    EXPECT_EQ(bench.show(2 + gap, back + 50), PictureResult::taken);
    EXPECT_TRUE(bench.estimator.has_velocity());
  }
}

TEST(Estimator, APoseWithoutItsBallIsNoPicture) {
  Bench bench;
  bench.estimator.take(RobotSighting{.picture = 1}, 0);
  bench.estimator.take(BallSighting{.picture = 2}, 0);
  EXPECT_EQ(bench.end_tick(0), PictureResult::none);
  bench.estimator.take(RobotSighting{.picture = 2}, 1);
  EXPECT_EQ(bench.end_tick(1), PictureResult::taken);
}

TEST(Estimator, AnOldPoseDoesNotPairWithTheBallThatHasItsNumberAgain) {
  Bench bench;
  bench.show(4, 1000);
  bench.estimator.take(RobotSighting{.picture = 5, .position_um = {700'000, 0}}, 1050);
  bench.end_tick(1050);
  for (std::uint32_t number = 6; number <= 21; ++number) {
    bench.estimator.take(BallSighting{.picture = static_cast<std::int32_t>(number % 16)},
                         1050 + 50 * (number - 5));
    EXPECT_EQ(bench.end_tick(1050 + 50 * (number - 5)), PictureResult::none) << number;
  }
}

TEST(Estimator, WhatCannotBeIsNotTaken) {
  Bench bench;
  bench.show(0, 0);
  EXPECT_EQ(bench.show(1, 50, {.position_um = {300'000, 0}}), PictureResult::implausible) << "6 m/s";
  EXPECT_EQ(bench.show(2, 100), PictureResult::taken);
  bench.estimator.take(RobotSighting{.picture = 3}, 150);
  bench.estimator.take(BallSighting{.picture = 3, .position_um = {-8'000'000, 0}}, 150);
  EXPECT_EQ(bench.end_tick(150), PictureResult::implausible);
}

TEST(Estimator, ARobotThatMovesOtherwiseThanItsWheelsIsAMismatch) {
  Bench stands;
  stands.show(0, 0);
  EXPECT_EQ(stands.show(1, 50, {.position_um = {60'000, 0}}), PictureResult::mismatched);
  Bench rolls;
  rolls.show(0, 0);
  rolls.odometry.take({1200, 1200});
  EXPECT_EQ(rolls.show(1, 50, {.position_um = {60'000, 0}}), PictureResult::taken);
  Bench turns;
  turns.show(0, 0);
  EXPECT_EQ(turns.show(1, 50, {.heading = 16384}), PictureResult::mismatched);
  Bench rolls_about;
  rolls_about.show(0, 0);
  rolls_about.odometry.take({-2200, 2200});  // a quarter of a circle in 50 ms
  EXPECT_EQ(rolls_about.show(1, 50, {.heading = 16384}), PictureResult::taken);
}

TEST(Estimator, APictureCountsFromWhenItWasReceived) {
  Bench bench;
  bench.show(0, 0);
  bench.odometry.take({1000, 1000});
  bench.estimator.take(RobotSighting{.picture = 1, .position_um = {50'000, 0}, .age_ticks = 30}, 80);
  bench.estimator.take(BallSighting{.picture = 1, .position_um = {250 * 4300, 250 * -200}, .age_ticks = 30},
                       80);
  EXPECT_EQ(bench.end_tick(80), PictureResult::taken);
  EXPECT_EQ(bench.estimator.picture_tick(), 50U);
  EXPECT_EQ(bench.at(80).ball_um.x, 4300 * 250 + 30 * 1500);
  EXPECT_NEAR(bench.at(80).robot_um.x, 80'000, 30);
}

// A robot that gains 11 m/s^2 and a ball that rolls, seen late: the estimate is of now all the same.
TEST(Estimator, ALatePictureIsLedOnByTheWayTheRobotHasGoneSince) {
  for (const std::int32_t latency_ms : {0, 7, 20, 35, 49, 50}) {
    Bench bench;
    bench.told.camera_latency_ticks = latency_ms;
    std::int32_t robot_um = 0;
    std::array<std::int32_t, 600> robot_at{};
    PictureResult worst = PictureResult::taken;
    for (std::uint32_t tick = 1; tick < 600; ++tick) {
      const std::int32_t speed_mm_s = tick < 300 ? 11 * static_cast<std::int32_t>(tick) / 2
                                                 : 1650 - 11 * (static_cast<std::int32_t>(tick) - 300);
      robot_um += speed_mm_s;
      robot_at.at(tick) = robot_um;
      bench.odometry.take({speed_mm_s, speed_mm_s});
      const std::uint32_t taken = tick - static_cast<std::uint32_t>(latency_ms);
      if (tick > 60 && taken % 50 == 0) {
        const std::int32_t number = static_cast<std::int32_t>(taken / 50) % 16;
        const auto rolled_um = static_cast<std::int32_t>(taken) * 1500;
        bench.estimator.take(RobotSighting{.picture = number, .position_um = {robot_at.at(taken), 0}}, tick);
        bench.estimator.take(BallSighting{.picture = number, .position_um = {1'000'000 - rolled_um, 0}},
                             tick);
      }
      const PictureResult result = bench.end_tick(tick);
      worst = result == PictureResult::none ? worst : std::max(worst, result);
      if (tick > 200) {
        ASSERT_NEAR(bench.at(tick).robot_um.x, robot_um, 30) << latency_ms << " ms, tick " << tick;
        ASSERT_NEAR(bench.at(tick).ball_um.x, 1'000'000 - static_cast<std::int32_t>(tick) * 1500, 30);
      }
    }
    EXPECT_EQ(worst, PictureResult::taken) << latency_ms;
  }
}

TEST(Estimator, BetweenPicturesBallAndRobotAreLedOn) {
  Bench bench;
  const RobotSighting facing_left{.position_um = {100'000, 200'000}, .heading = 16384};
  bench.show(0, 0, facing_left);
  bench.show(1, 50, facing_left);
  bench.odometry.take({.left_mm_s = 1000, .right_mm_s = 1200});
  for (std::uint32_t tick = 51; tick <= 70; ++tick) {
    EXPECT_EQ(bench.end_tick(tick), PictureResult::none);
  }
  const Estimate estimate = bench.at(70);
  EXPECT_EQ(estimate.robot_speed_mm_s, 1100);
  EXPECT_NEAR(estimate.robot_um.x, 100'000, 30);
  EXPECT_NEAR(estimate.robot_um.y, 200'000 + 20 * 1100, 30);
  EXPECT_EQ(estimate.ball_um.x, 4300 * 250 + 20 * 1500);
}

TEST(Estimator, MissedTicksAreLedOverToo) {
  Bench every;
  Bench some;
  for (Bench* bench : {&every, &some}) {
    bench->show(0, 0);
    bench->odometry.take({.left_mm_s = 2000, .right_mm_s = 2000});
  }
  for (std::uint32_t tick = 1; tick <= 30; ++tick) {
    every.end_tick(tick);
  }
  some.end_tick(11);
  some.end_tick(30);
  EXPECT_EQ(every.at(30).robot_um.x, some.at(30).robot_um.x);
}

TEST(Estimator, AfterAResetNothingOfTheOldPicturesIsLeft) {
  Bench used;
  Bench fresh;
  used.show(3, 0);
  used.show(4, 50);
  used.estimator.reset();
  EXPECT_FALSE(used.estimator.has_velocity());
  for (Bench* bench : {&used, &fresh}) {
    bench->show(9, 100);
    EXPECT_FALSE(bench->estimator.has_velocity());
    bench->show(10, 150);
  }
  EXPECT_EQ(used.at(150).ball_um.x, fresh.at(150).ball_um.x);
  EXPECT_EQ(used.at(150).ball_velocity_mm_s.y, fresh.at(150).ball_velocity_mm_s.y);
}

// Hours without a picture, and time that goes back, must not overflow (UBSan watches).
TEST(Estimator, ALongSilenceStaysWithinBounds) {
  Bench bench;
  bench.show(0, 0);
  bench.show(1, 50);
  bench.odometry.take({.left_mm_s = 8000, .right_mm_s = 8000});
  for (std::uint32_t tick = 51; tick < 2'000'000; ++tick) {
    bench.end_tick(tick);
  }
  for (const std::uint32_t tick : {1'999'998U, 1'999'999U, 5U, 4U, 0xFFFFFFFFU, 3U}) {
    bench.end_tick(tick);
  }
  EXPECT_LT(bench.at(2'000'000).robot_um.x, 20'000'000);
}

}  // namespace
}  // namespace striker::core

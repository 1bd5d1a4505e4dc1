// SPDX-License-Identifier: Apache-2.0
// The estimator on ideal pictures: exact velocities, lead between pictures, and nothing kept after a reset.
#include "firmware/core/estimation/estimator.hpp"

#include <gtest/gtest.h>

namespace striker::core {
namespace {

// Puts a picture of a ball that moves 3 counts along x and -2 along y a frame into the estimator.
bool show(Estimator& estimator, std::int32_t number, std::uint32_t tick, RobotSighting robot = {}) {
  robot.picture = number % 16;
  estimator.take(robot);
  estimator.take(BallSighting{.picture = number % 16,
                              .position_um = {250 * (4000 + 300 * number), 250 * -200 * number}});
  return estimator.end_tick(tick);
}

TEST(Estimator, VelocityIsTheDifferenceOfTheLastTwoPictures) {
  Estimator estimator;
  EXPECT_TRUE(show(estimator, 0, 0));
  EXPECT_FALSE(estimator.has_velocity());
  EXPECT_TRUE(show(estimator, 1, 50));
  ASSERT_TRUE(estimator.has_velocity());
  const Estimate estimate = estimator.at(50);
  EXPECT_EQ(estimate.ball_um.x, 4300 * 250);
  EXPECT_EQ(estimate.ball_velocity_mm_s.x, 1500);  // 300 counts of 0.25 mm in 50 ms
  EXPECT_EQ(estimate.ball_velocity_mm_s.y, -1000);
}

TEST(Estimator, LostFramesAreCountedByTheirNumbersNotByTime) {
  for (std::int32_t step = 1; step <= 16; ++step) {
    Estimator estimator;
    show(estimator, 14, 0);
    const bool complete = show(estimator, 14 + step, 7);  // the arrival does not matter
    EXPECT_EQ(complete, step != 16) << "a repeated frame number is the same picture";
    EXPECT_EQ(estimator.has_velocity(), step <= greatest_picture_step) << step;
    if (estimator.has_velocity()) {
      EXPECT_EQ(estimator.at(7).ball_velocity_mm_s.x, 1500) << step;
    }
  }
}

TEST(Estimator, APoseWithoutItsBallIsNoPicture) {
  Estimator estimator;
  estimator.take(RobotSighting{.picture = 1});
  estimator.take(BallSighting{.picture = 2});
  EXPECT_FALSE(estimator.end_tick(0));
  estimator.take(RobotSighting{.picture = 2});
  EXPECT_TRUE(estimator.end_tick(1));
}

TEST(Estimator, BetweenPicturesBallAndRobotAreLedOn) {
  Estimator estimator;
  const RobotSighting facing_left{.position_um = {100'000, 200'000}, .heading = 16384};
  show(estimator, 0, 0, facing_left);
  show(estimator, 1, 50, facing_left);
  estimator.take(WheelSpeeds{.left_mm_s = 1000, .right_mm_s = 1200});
  for (std::uint32_t tick = 51; tick <= 70; ++tick) {
    EXPECT_FALSE(estimator.end_tick(tick));
  }
  const Estimate estimate = estimator.at(70);
  EXPECT_EQ(estimate.robot_speed_mm_s, 1100);
  EXPECT_NEAR(estimate.robot_um.x, 100'000, 30);
  EXPECT_NEAR(estimate.robot_um.y, 200'000 + 20 * 1100, 30);
  EXPECT_EQ(estimate.ball_um.x, 4300 * 250 + 20 * 1500);
}

TEST(Estimator, MissedTicksAreLedOverToo) {
  Estimator every;
  Estimator some;
  for (Estimator* estimator : {&every, &some}) {
    show(*estimator, 0, 0);
    estimator->take(WheelSpeeds{.left_mm_s = 2000, .right_mm_s = 2000});
  }
  for (std::uint32_t tick = 1; tick <= 30; ++tick) {
    every.end_tick(tick);
  }
  some.end_tick(11);
  some.end_tick(30);
  EXPECT_EQ(every.at(30).robot_um.x, some.at(30).robot_um.x);
}

TEST(Estimator, AfterAResetNothingOfTheOldPicturesIsLeft) {
  Estimator used;
  Estimator fresh;
  show(used, 3, 0);
  show(used, 4, 50);
  used.reset();
  EXPECT_FALSE(used.has_velocity());
  for (Estimator* estimator : {&used, &fresh}) {
    show(*estimator, 9, 100);
    EXPECT_FALSE(estimator->has_velocity());
    show(*estimator, 10, 150);
  }
  EXPECT_EQ(used.at(150).ball_um.x, fresh.at(150).ball_um.x);
  EXPECT_EQ(used.at(150).ball_velocity_mm_s.y, fresh.at(150).ball_velocity_mm_s.y);
}

// Hours without a picture must not overflow (UBSan watches).
TEST(Estimator, ALongSilenceStaysWithinBounds) {
  Estimator estimator;
  show(estimator, 0, 0);
  show(estimator, 1, 50);
  estimator.take(WheelSpeeds{.left_mm_s = 8000, .right_mm_s = 8000});
  for (std::uint32_t tick = 51; tick < 2'000'000; ++tick) {
    estimator.end_tick(tick);
  }
  EXPECT_LT(estimator.at(2'000'000).robot_um.x, 20'000'000);
}

}  // namespace
}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The independent check by property: what gets through never moves without a cause, a limit or a sane wheel.
#include "firmware/core/supervision/command_check.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "firmware/core/robot_profile.hpp"

namespace striker::core {
namespace {

constexpr RobotProfile robot = profile_of(forward);

TEST(CommandCheck, WhatPassesHasACauseAndKeepsTheLimits) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> torque(-600, 600);
  std::uniform_int_distribution<std::int32_t> set_point(-2800, 2800);
  std::uniform_int_distribution<std::int32_t> speed(-4000, 4000);
  std::bernoulli_distribution often(0.9);
  int passed = 0;
  for (int i = 0; i < 200'000; ++i) {
    const DriveCommand c{{torque(random), torque(random)}, {set_point(random), set_point(random)}};
    const DriveFacts facts{often(random), often(random), often(random), {speed(random), speed(random)}};
    if (check_command(robot, c, facts) != Fault::none) {
      continue;
    }
    ++passed;
    ASSERT_TRUE(facts.armed && facts.vision_fresh && facts.wheels_fresh);
    ASSERT_LE(std::abs(c.torque.left_mNm), robot.torque_limit_mNm);
    ASSERT_LE(std::abs(c.torque.right_mNm), robot.torque_limit_mNm);
    ASSERT_LE(std::abs(c.set_point.left_mm_s), robot.top_rim_speed_mm_s);
    ASSERT_LE(std::abs(c.set_point.right_mm_s), robot.top_rim_speed_mm_s);
    const bool runs_away_left = std::abs(facts.measured.left_mm_s) > robot.overspeed_mm_s &&
                                std::int64_t{c.torque.left_mNm} * facts.measured.left_mm_s > 0;
    const bool runs_away_right = std::abs(facts.measured.right_mm_s) > robot.overspeed_mm_s &&
                                 std::int64_t{c.torque.right_mNm} * facts.measured.right_mm_s > 0;
    ASSERT_FALSE(runs_away_left || runs_away_right);
  }
  EXPECT_GT(passed, 10'000);
}

// Whatever one of the four figures is not zero moves: it needs its cause.
TEST(CommandCheck, EachFigureAloneNeedsACause) {
  const DriveFacts all{true, true, true, {}};
  for (const DriveCommand& c : {DriveCommand{{1, 0}, {}}, DriveCommand{{0, -1}, {}}, DriveCommand{{}, {1, 0}},
                                DriveCommand{{}, {0, -1}}}) {
    EXPECT_EQ(check_command(robot, c, all), Fault::none);
    for (const DriveFacts& facts : {DriveFacts{false, true, true, {}}, DriveFacts{true, false, true, {}},
                                    DriveFacts{true, true, false, {}}}) {
      EXPECT_EQ(check_command(robot, c, facts), Fault::command_rejected);
    }
  }
}

TEST(CommandCheck, WhatIsNotSaidIsNoCause) {
  constexpr DriveFacts silent;
  EXPECT_FALSE(silent.armed || silent.vision_fresh || silent.wheels_fresh);
}

TEST(CommandCheck, TheLimitsThemselvesPass) {
  const DriveFacts at_overspeed{true, true, true, {robot.overspeed_mm_s, -robot.overspeed_mm_s}};
  const DriveCommand greatest{{robot.torque_limit_mNm, -robot.torque_limit_mNm},
                              {robot.top_rim_speed_mm_s, -robot.top_rim_speed_mm_s}};
  EXPECT_EQ(check_command(robot, greatest, at_overspeed), Fault::none);
  for (const std::int32_t sign : {-1, 1}) {
    for (const bool left : {false, true}) {
      DriveCommand torque;
      DriveCommand set_point;
      DriveFacts faster{true, true, true, {}};
      (left ? torque.torque.left_mNm : torque.torque.right_mNm) = sign * (robot.torque_limit_mNm + 1);
      (left ? set_point.set_point.left_mm_s : set_point.set_point.right_mm_s) =
          sign * (robot.top_rim_speed_mm_s + 1);
      (left ? faster.measured.left_mm_s : faster.measured.right_mm_s) = sign * (robot.overspeed_mm_s + 1);
      EXPECT_EQ(check_command(robot, torque, at_overspeed), Fault::command_rejected);
      EXPECT_EQ(check_command(robot, set_point, at_overspeed), Fault::command_rejected);
      EXPECT_EQ(check_command(robot, {.torque = {sign, sign}, .set_point = {}}, faster), Fault::overspeed);
    }
  }
}

TEST(CommandCheck, NoTorqueAndNoSetPointAlwaysPass) {
  EXPECT_EQ(check_command(robot, {}, {}), Fault::none);
}

TEST(CommandCheck, BrakingAnOverspeedWheelIsAllowed) {
  const DriveFacts fast{true, true, true, {3500, 3500}};
  EXPECT_EQ(check_command(robot, {.torque = {-100, -100}, .set_point = {}}, fast), Fault::none);
  EXPECT_EQ(check_command(robot, {.torque = {1, -100}, .set_point = {}}, fast), Fault::overspeed);
}

}  // namespace
}  // namespace striker::core

// The independent check by property: what gets through never moves without a cause, a limit or a sane wheel.
#include "firmware/core/command_check.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "firmware/core/wheel_loop.hpp"

namespace striker::core {
namespace {

TEST(CommandCheck, WhatPassesHasACauseAndKeepsTheLimits) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> torque(-600, 600);
  std::uniform_int_distribution<std::int32_t> set_point(-1400, 1400);
  std::uniform_int_distribution<std::int32_t> speed(-4000, 4000);
  std::bernoulli_distribution often(0.9);
  int passed = 0;
  for (int i = 0; i < 200'000; ++i) {
    const can::WheelCommand c{0, torque(random), torque(random), set_point(random), set_point(random)};
    const DriveFacts facts{often(random), often(random), often(random), {0, speed(random), speed(random)}};
    if (check_command(c, facts) != can::Fault::none) {
      continue;
    }
    ++passed;
    ASSERT_TRUE(facts.armed && facts.vision_fresh && facts.wheels_fresh);
    ASSERT_LE(std::abs(c.left_torque_mNm), torque_limit_mNm);
    ASSERT_LE(std::abs(c.right_torque_mNm), torque_limit_mNm);
    ASSERT_LE(std::abs(c.left_set_point_2mm_s), top_rim_speed_mm_s / 2);
    ASSERT_LE(std::abs(c.right_set_point_2mm_s), top_rim_speed_mm_s / 2);
    const bool runs_away_left = std::abs(facts.wheels.left_mm_s) > overspeed_mm_s &&
                                std::int64_t{c.left_torque_mNm} * facts.wheels.left_mm_s > 0;
    const bool runs_away_right = std::abs(facts.wheels.right_mm_s) > overspeed_mm_s &&
                                 std::int64_t{c.right_torque_mNm} * facts.wheels.right_mm_s > 0;
    ASSERT_FALSE(runs_away_left || runs_away_right);
  }
  EXPECT_GT(passed, 10'000);
}

TEST(CommandCheck, NoTorqueAndNoSetPointAlwaysPass) {
  EXPECT_EQ(check_command({}, {}), can::Fault::none);
}

TEST(CommandCheck, BrakingAnOverspeedWheelIsAllowed) {
  const DriveFacts fast{true, true, true, {0, 3500, 3500}};
  EXPECT_EQ(check_command({.left_torque_mNm = -100, .right_torque_mNm = -100}, fast), can::Fault::none);
  EXPECT_EQ(check_command({.left_torque_mNm = 1, .right_torque_mNm = -100}, fast), can::Fault::overspeed);
}

}  // namespace
}  // namespace striker::core

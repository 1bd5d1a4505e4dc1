// SPDX-License-Identifier: Apache-2.0
// What was told and does not act yet, and what a decision is made for because of it.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "firmware/core/estimation/command_lead.hpp"
#include "firmware/core/pending_torque.hpp"

namespace striker::core {
namespace {

RobotProfile told(std::int32_t delay_ms) {
  RobotDescription late = forward;
  late.command_delay_ms = delay_ms;
  return profile_of(late);
}

TEST(PendingTorque, ActsTheToldTimeLaterAndAddsUpUntilThen) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> torque(-400, 400);  // the forward's limit
  for (const std::int32_t delay_ticks : {0, 1, 2, 20, 49, 50}) {
    const RobotProfile robot = told(delay_ticks);
    PendingTorque pending;
    std::deque<std::int32_t> expected(static_cast<std::size_t>(delay_ticks), 0);
    for (int tick = 0; tick < 1'000; ++tick) {
      expected.push_back(torque(random));
      // Kept to a 127th of the limit, towards 0.
      ASSERT_NEAR(pending.give(robot, expected.back()), expected.front(), 400.0 / 127.0 + 1.0)
          << delay_ticks << ' ' << tick;
      expected.pop_front();
      double sum_mNm_ticks = 0.0;
      for (const std::int32_t still : expected) {
        sum_mNm_ticks += still;
      }
      // 27.8 mm/s^2 for each mNm (robot_profile.hpp).
      ASSERT_NEAR(pending.speed_change_mm_s(robot), 27.8e-3 * sum_mNm_ticks,
                  1.0 + 27.8e-3 * 2.0 * delay_ticks + 0.01 * std::abs(27.8e-3 * sum_mNm_ticks));
    }
  }
}

const Estimate seen = {.robot_um = {1'000'000, -500'000},
                       .heading = 0x4000,  // along y
                       .robot_speed_mm_s = 1'000,
                       .ball_um = {2'000'000, 0},
                       .ball_velocity_mm_s = {-1'500, 250}};

TEST(CommandLead, LeadsRobotAndBallThroughTheDelay) {
  const Estimate then = led_through_delay(told(20), seen, 200);
  EXPECT_NEAR(then.robot_um.x, 1'000'000, 20);
  EXPECT_NEAR(then.robot_um.y, -500'000 + 20 * 1'100, 20);
  EXPECT_EQ(then.robot_speed_mm_s, 1'200);
  EXPECT_EQ(then.heading, seen.heading);
  EXPECT_EQ(then.ball_um.x, 2'000'000 - 20 * 1'500);
  EXPECT_EQ(then.ball_um.y, 20 * 250);
  EXPECT_EQ(then.ball_velocity_mm_s.x, -1'500);
}

TEST(CommandLead, WithoutADelayNothingChanges) {
  const Estimate then = led_through_delay(told(0), seen, 0);
  EXPECT_EQ(then.robot_um.y, seen.robot_um.y);
  EXPECT_EQ(then.robot_speed_mm_s, seen.robot_speed_mm_s);
  EXPECT_EQ(then.ball_um.x, seen.ball_um.x);
}

}  // namespace
}  // namespace striker::core

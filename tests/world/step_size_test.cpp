// SPDX-License-Identifier: Apache-2.0
// 10 ms and 1 ms steps simulate the same world.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

TEST(StepSize, ADriveEndsAtTheSamePlace) {
  World coarse(kick_world(0.010));
  World fine(kick_world(0.001));
  for (World* world : {&coarse, &fine}) {
    world->place_robot(0, {});
    for (const double speed_m_s : {2.55, -2.55, 0.0}) {
      drive_straight(*world, speed_m_s);
      run(*world, 0.6);
    }
  }
  EXPECT_NEAR(coarse.robot_pose(0).x_m, fine.robot_pose(0).x_m, 0.03);
  EXPECT_NEAR(coarse.robot_velocity_m_s(0).x, fine.robot_velocity_m_s(0).x, 0.01);
}

TEST(StepSize, ATurnEndsInTheSameHeading) {
  World coarse(kick_world(0.010));
  World fine(kick_world(0.001));
  for (World* world : {&coarse, &fine}) {
    world->place_robot(0, {});
    drive(*world, 0, 0.5, 0.7, 0.4);
    run(*world, 1.0);
  }
  EXPECT_NEAR(coarse.robot_pose(0).heading_rad, fine.robot_pose(0).heading_rad, 0.05);
  EXPECT_NEAR(coarse.robot_pose(0).x_m, fine.robot_pose(0).x_m, 0.02);
  EXPECT_NEAR(coarse.robot_pose(0).y_m, fine.robot_pose(0).y_m, 0.02);
}

TEST(StepSize, AKickLeavesAlike) {
  World coarse(kick_world(0.010));
  World fine(kick_world(0.001));
  const KickStart start = {.robot = {}, .ball = {.position_m = {1.2, 0.01}, .velocity_m_s = {-1.0, 0.0}}};
  const Actions forward(kick_decisions, 1);
  const KickOutcome a = play(coarse, start, forward);
  const KickOutcome b = play(fine, start, forward);
  EXPECT_NEAR(a.theta_contact_rad, b.theta_contact_rad, 0.05);
  EXPECT_NEAR(a.v_contact_m_s, b.v_contact_m_s, 0.15);
  EXPECT_NEAR(a.ball_speed_m_s, b.ball_speed_m_s, 0.4);
  EXPECT_NEAR(a.ball_angle_rad, b.ball_angle_rad, 0.1);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// The driving of the team `striker`, with robots that do exactly what they are told.
#include "sil/match/team/striker/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

constexpr double top_m_s = 2.1;
constexpr double axle_m = 0.14;
constexpr double step_s = 0.01;

void move(Pose& robot, SpeedOrder wheels) {
  for (int step = 0; step < 5; ++step) {
    robot.heading_rad =
        wrapped_rad(robot.heading_rad + step_s * (wheels.right_m_s - wheels.left_m_s) / axle_m);
    const double ahead_m = step_s * (wheels.left_m_s + wheels.right_m_s) / 2.0;
    robot.x_m += ahead_m * std::cos(robot.heading_rad);
    robot.y_m += ahead_m * std::sin(robot.heading_rad);
  }
}

Pose anywhere(Random& random) {
  const double x_m = random.uniform(-3.8, 3.8);
  const double y_m = random.uniform(-2.2, 2.2);
  return {x_m, y_m, random.uniform(-3.1, 3.1)};
}

TEST(DriveTo, ArrivesAndStops) {
  Random random(1, 0, 1);
  for (int round = 0; round < 500; ++round) {
    Pose robot = anywhere(random);
    const Vec2 target = place_of(anywhere(random));
    const double straight_s = distance_m(place_of(robot), target) / top_m_s;
    int frames = 0;
    while (drive_to(robot, target, top_m_s) != SpeedOrder{} && frames < 400) {
      move(robot, drive_to(robot, target, top_m_s));
      ++frames;
    }
    ASSERT_LT(frames * 0.05, straight_s + 3.0) << round;
    ASSERT_LT(distance_m(place_of(robot), target), 0.02);
  }
}

TEST(DriveTo, PassesAtTheSpeedItIsTold) {
  const SpeedOrder wheels = drive_to({0.0, 0.0, 0.0}, {0.05, 0.0}, top_m_s, 1.5);
  EXPECT_NEAR(wheels.left_m_s, 1.5, 1e-12);
  EXPECT_NEAR(wheels.right_m_s, 1.5, 1e-12);
}

TEST(DriveTo, GoesBackwardsToWhatIsBehind) {
  const SpeedOrder wheels = drive_to({0.0, 0.0, 0.0}, {-1.0, 0.0}, top_m_s);
  EXPECT_NEAR(wheels.left_m_s, -top_m_s, 1e-12);
  EXPECT_NEAR(wheels.right_m_s, -top_m_s, 1e-12);
}

TEST(DriveThrough, IsAtTopSpeedWhereItHasToGo) {
  Pose robot = {0.0, 0.0, 0.3};
  for (int frame = 0; frame < 20; ++frame) {
    move(robot, drive_through(robot, {3.0, 0.0}, top_m_s));
  }
  EXPECT_GT(robot.x_m, 1.9);
  EXPECT_NEAR(robot.y_m, 0.0, 0.2);
}

TEST(Face, TurnsTheFrontAndNotTheBack) {
  Pose robot = {0.0, 0.0, 3.0};
  for (int frame = 0; frame < 40; ++frame) {
    move(robot, face(robot, 0.5, top_m_s));
  }
  EXPECT_NEAR(robot.heading_rad, 0.5, 0.02);
  EXPECT_NEAR(distance_m(place_of(robot), {}), 0.0, 1e-9);
}

}  // namespace
}  // namespace striker::sil

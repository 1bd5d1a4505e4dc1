// SPDX-License-Identifier: Apache-2.0
// The ball on the floor, at the walls, in the goals and at the robots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

World field_world() {
  return World({.robots = {robot_spec(Role::forward)}, .walls = true, .step_s = 0.010});
}

double speed_m_s(const BallState& ball) {
  return std::hypot(ball.velocity_m_s.x, ball.velocity_m_s.y);
}

TEST(Ball, RestingItStays) {
  World world = field_world();
  world.place_ball({.position_m = {1.0, -0.5}, .velocity_m_s = {}});
  run(world, 10.0);
  EXPECT_NEAR(world.ball().position_m.x, 1.0, 1e-9);
  EXPECT_NEAR(world.ball().position_m.y, -0.5, 1e-9);
}

TEST(Ball, RollingItLosesTwentyPerCentASecondInAnyDirection) {
  for (const double step_s : {0.001, 0.010}) {
    World world(kick_world(step_s));
    for (const double direction_rad : {0.0, 0.7, 2.5, -1.2}) {
      world.place_ball(
          {.position_m = {}, .velocity_m_s = {2.0 * std::cos(direction_rad), 2.0 * std::sin(direction_rad)}});
      run(world, 1.0);
      EXPECT_NEAR(speed_m_s(world.ball()), 1.6, 1e-3);
      EXPECT_NEAR(std::atan2(world.ball().position_m.y, world.ball().position_m.x), direction_rad, 1e-4);
    }
  }
}

TEST(Ball, BouncesOffTheSideWallWithThreeQuartersOfItsSpeed) {
  for (const double side : {-1.0, 1.0}) {
    World world = field_world();
    world.place_ball({.position_m = {0.0, side * 2.0}, .velocity_m_s = {0.0, side * 2.0}});
    while (world.ball().velocity_m_s.y * side > 0.0) {
      world.step();
    }
    EXPECT_NEAR(world.ball().velocity_m_s.y * side, -0.75 * 1.93, 0.1);
  }
}

TEST(Ball, TheGoalMouthIsOpenAndItsBackIsClosed) {
  for (const double side : {-1.0, 1.0}) {
    World world = field_world();
    world.place_ball({.position_m = {side * 3.5, 0.2}, .velocity_m_s = {side * 2.0, 0.0}});
    double deepest_m = 0.0;
    for (int i = 0; i < 100; ++i) {
      world.step();
      deepest_m = std::max(deepest_m, side * world.ball().position_m.x);
    }
    EXPECT_GT(deepest_m, field_half_length_m + 0.3);
    EXPECT_LT(deepest_m, goal_back_m);
  }
}

TEST(Ball, TheEndWallBesideTheGoalIsClosed) {
  for (const double y_m : {-1.5, -0.6, 0.6, 2.0}) {
    World world = field_world();
    world.place_ball({.position_m = {3.5, y_m}, .velocity_m_s = {3.0, 0.0}});
    run(world, 0.5);
    EXPECT_LT(world.ball().velocity_m_s.x, 0.0) << y_m;
    EXPECT_LT(world.ball().position_m.x, field_half_length_m) << y_m;
  }
}

TEST(Ball, TheCornerTurnsIt) {
  World world = field_world();
  const double inset_m = field_half_length_m + field_half_width_m - corner_leg_m;
  world.place_ball({.position_m = {3.4, 1.825}, .velocity_m_s = {2.0, 2.0}});
  for (int i = 0; i < 50; ++i) {
    world.step();
    // Its surface enters the corner by no more than it moves in a step; without the cut its centre would
    // come within a radius of both walls.
    const Vec2 ball = world.ball().position_m;
    EXPECT_LT((ball.x + ball.y - inset_m) / std::numbers::sqrt2, -ball_radius_m + 0.03);
  }
  EXPECT_LT(world.ball().velocity_m_s.x, 0.0);
  EXPECT_LT(world.ball().velocity_m_s.y, 0.0);
}

// No kick gives more than 7 m/s. In a step of 10 ms the ball then meets a wall as late as 0.02 m after its
// centre has passed it.
TEST(Ball, NeverLeavesTheField) {
  constexpr double late_m = 0.021;
  World world = field_world();
  world.place_robot(0, {.x_m = -1.0, .y_m = 0.3, .heading_rad = 0.4});
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(1, i, 0);
    const double direction_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
    world.place_ball({.position_m = {random.uniform(-0.5, 3.5), random.uniform(-2.0, 2.0)},
                      .velocity_m_s = {7.0 * std::cos(direction_rad), 7.0 * std::sin(direction_rad)}});
    for (int step = 0; step < 200; ++step) {
      world.step();
      const Vec2 ball = world.ball().position_m;
      ASSERT_LT(std::abs(ball.y), field_half_width_m + late_m) << "ball " << i;
      ASSERT_LT(std::abs(ball.x), goal_back_m + late_m) << "ball " << i;
      ASSERT_TRUE(std::abs(ball.x) < field_half_length_m + late_m ||
                  std::abs(ball.y) < goal_half_width_m + late_m)
          << "ball " << i << " at " << ball.x << ", " << ball.y;
    }
  }
}

TEST(Ball, AnOpenFloorHasNoWalls) {
  World world(kick_world(0.010));
  world.place_ball({.position_m = {3.5, 2.0}, .velocity_m_s = {3.0, 3.0}});
  run(world, 1.0);
  EXPECT_GT(world.ball().position_m.x, 5.5);
  EXPECT_GT(world.ball().position_m.y, 4.0);
}

TEST(Ball, MeetsTheRobotsFacesAndTellsTheNormal) {
  constexpr double half_pi = 0.5 * std::numbers::pi;
  for (const double from_rad : {0.0, half_pi, -half_pi, 2.0 * half_pi}) {
    World world(kick_world(0.001));
    const double heading_rad = 0.3;
    const Vec2 side{std::cos(heading_rad + from_rad), std::sin(heading_rad + from_rad)};
    world.place_robot(0, {.x_m = 0.5, .y_m = -0.2, .heading_rad = heading_rad});
    world.place_ball({.position_m = {0.5 + 0.3 * side.x, -0.2 + 0.3 * side.y},
                      .velocity_m_s = {-1.5 * side.x, -1.5 * side.y}});
    int steps = 0;
    while (!world.ball_contact(0) && steps < 1000) {
      world.step();
      ++steps;
    }
    // 0.3 m less half a side and the radius, at 1.5 m/s.
    EXPECT_NEAR(steps, 118, 3);
    ASSERT_TRUE(world.ball_contact(0));
    EXPECT_NEAR(world.ball_contact(0)->x, side.x, 1e-3);
    EXPECT_NEAR(world.ball_contact(0)->y, side.y, 1e-3);
    run(world, 0.020);
    EXPECT_FALSE(world.ball_contact(0));
    EXPECT_GT(world.ball().velocity_m_s.x * side.x + world.ball().velocity_m_s.y * side.y, 0.5);
  }
}

// mu g, and the damping besides.
TEST(Ball, KickedItSlidesAndTheFloorSlowsIt) {
  World world(kick_world(0.001));
  world.place_robot(0, {});
  world.place_ball({.position_m = {1.0, 0.0}, .velocity_m_s = {}});
  drive_straight(world, 2.55);
  while (world.ball().velocity_m_s.x == 0.0) {
    world.step();
  }
  run(world, 0.1);
  const double before_m_s = world.ball().velocity_m_s.x;
  run(world, 0.1);
  const double after_m_s = world.ball().velocity_m_s.x;
  EXPECT_NEAR((before_m_s - after_m_s) / 0.1, 0.1 * 9.81 + 0.223 * before_m_s, 0.1);
}

TEST(Ball, AGoalkeeperGivesLessBackThanAForward) {
  const auto returned_m_s = [](Role role) {
    World world({.robots = {robot_spec(role)}, .walls = false, .step_s = 0.010});
    world.place_robot(0, {});
    world.place_ball({.position_m = {0.5, 0.0}, .velocity_m_s = {-2.0, 0.0}});
    drive(world, 0, 0.0, 0.0, 0.4);
    run(world, 0.3);
    return world.ball().velocity_m_s.x;
  };
  EXPECT_GT(returned_m_s(Role::goalkeeper), 0.3);
  EXPECT_GT(returned_m_s(Role::forward), returned_m_s(Role::goalkeeper) + 0.2);
}

}  // namespace
}  // namespace striker::sil

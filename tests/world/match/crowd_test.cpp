// SPDX-License-Identifier: Apache-2.0
// Robots that press on each other: the planar model by itself, and the cut crowd beside the exact one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sil/world/ode/pile/planar_pile.hpp"
#include "tests/world/match/energy.hpp"
#include "tests/world/match/field_depth.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

constexpr double step_s = 0.010;

PileRobot free_robot(Vec2 at, Vec2 velocity) {
  return {.pose = {.x_m = at.x, .y_m = at.y, .heading_rad = 0.0},
          .velocity_m_s = velocity,
          .yaw_rate_rad_s = 0.0,
          .mass_along_kg = 1.7,
          .mass_across_kg = 1.7,
          .inertia_kg_m2 = 0.006,
          .half_axle_m = 0.065,
          .drives = {},
          .grip_N = 0.0};
}

double energy_J(const PileRobot& robot, const Vec3& speeds) {
  const double along =
      std::cos(robot.pose.heading_rad) * speeds.x + std::sin(robot.pose.heading_rad) * speeds.y;
  const double across =
      std::cos(robot.pose.heading_rad) * speeds.y - std::sin(robot.pose.heading_rad) * speeds.x;
  return 0.5 * (robot.mass_along_kg * along * along + robot.mass_across_kg * across * across +
                robot.inertia_kg_m2 * speeds.z * speeds.z);
}

TEST(PlanarPile, TwoRobotsExchangeMomentumWithTheTablesBounce) {
  PlanarPile pile;
  const std::size_t a = pile.add(free_robot({0.075, 0.0}, {-1.0, 0.0}));
  const std::size_t b = pile.add(free_robot({-0.075, 0.0}, {1.5, 0.0}));
  pile.add(
      {.a = a, .b = b, .at_m = {}, .normal = {1.0, 0.0}, .bounce = 0.25, .friction = 1.0, .part_m_s = 0.0});
  pile.solve(step_s);
  EXPECT_NEAR(pile.speeds_after(a).x + pile.speeds_after(b).x, 0.5, 1e-9);
  EXPECT_NEAR(pile.speeds_after(a).x - pile.speeds_after(b).x, 0.25 * 2.5, 1e-9);
  EXPECT_NEAR(pile.impulse_Ns(0).x, 1.7 * (pile.speeds_after(a).x + 1.0), 1e-9);
}

TEST(PlanarPile, PressingOnAWallTheWallTakesTheMotorsForceThroughThree) {
  PlanarPile pile;
  for (int i = 0; i < 3; ++i) {
    PileRobot robot = free_robot({-0.075 - 0.15 * i, 0.0}, {});
    robot.drives = {{{.rim_speed_m_s = 2.0, .force_N = 12.0}, {.rim_speed_m_s = 2.0, .force_N = 12.0}}};
    robot.grip_N = 30.0;
    pile.add(robot);
  }
  const Vec2 back{-1.0, 0.0};
  pile.add({.a = 0, .b = {}, .at_m = {}, .normal = back, .bounce = 0.0, .friction = 1.0, .part_m_s = 0.0});
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec2 at{-0.15 * static_cast<double>(i), 0.0};
    pile.add(
        {.a = i, .b = i - 1, .at_m = at, .normal = back, .bounce = 0.25, .friction = 1.0, .part_m_s = 0.0});
  }
  pile.solve(step_s);
  EXPECT_NEAR(pile.impulse_Ns(0).x, -3.0 * 24.0 * step_s, 1e-3);
  EXPECT_NEAR(pile.impulse_Ns(1).x, -2.0 * 24.0 * step_s, 1e-3);
  EXPECT_NEAR(pile.impulse_Ns(2).x, -1.0 * 24.0 * step_s, 1e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(pile.speeds_after(i).x, 0.0, 1e-3);
  }
}

// Motors off, contacts at random: a crowd's energy falls.
TEST(PlanarPile, AddsNoEnergy) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random(21, i, 0);
    PlanarPile pile;
    double before_J = 0.0;
    std::vector<PileRobot> robots;
    for (int k = 0; k < 10; ++k) {
      const int row = k / 4;
      PileRobot robot =
          free_robot({0.16 * (k % 4), 0.16 * row}, {random.uniform(-2, 2), random.uniform(-2, 2)});
      robot.pose.heading_rad = random.uniform(-3.0, 3.0);
      robot.mass_along_kg = 1.8;
      robot.grip_N = random.uniform(0.0, 40.0);
      pile.add(robot);
      robots.push_back(robot);
      before_J += energy_J(robot, {robot.velocity_m_s.x, robot.velocity_m_s.y, 0.0});
    }
    for (std::size_t k = 0; k < 25; ++k) {
      const std::size_t a = random.below(10);
      const std::size_t b = (a + 1 + random.below(9)) % 10;
      const Pose& pose = robots[a].pose;
      const double normal_rad = random.uniform(-3.0, 3.0);
      pile.add({.a = a,
                .b = k % 5 == 0 ? std::nullopt : std::optional(b),
                .at_m = {pose.x_m + random.uniform(-0.07, 0.07), pose.y_m + random.uniform(-0.07, 0.07)},
                .normal = {std::cos(normal_rad), std::sin(normal_rad)},
                .bounce = 0.0,
                .friction = 1.0,
                .part_m_s = 0.0});
    }
    pile.solve(step_s);
    double after_J = 0.0;
    for (std::size_t k = 0; k < robots.size(); ++k) {
      after_J += energy_J(robots[k], pile.speeds_after(k));
    }
    EXPECT_LE(after_J, before_J + 1e-9) << i;
  }
}

// Four forwards in a row, the first against the side wall, after 1 s of pressing.
World pressed(bool cut) {
  World world({.robots = std::vector<RobotSpec>(4, robot_spec(Role::forward)),
               .walls = true,
               .step_s = step_s,
               .ball_can_be_held = true,
               .crowds_are_cut = cut});
  for (std::size_t i = 0; i < 4; ++i) {
    world.place_robot(i, {.x_m = 0.01 * static_cast<double>(i),
                          .y_m = 2.1 - 0.25 * static_cast<double>(i),
                          .heading_rad = 0.5 * std::numbers::pi});
    drive(world, i, 1.5, 1.5, 0.4);
  }
  world.place_ball({.position_m = {-2.0, 0.0}, .velocity_m_s = {}});
  run(world, 1.0);
  return world;
}

TEST(Crowd, CutItRestsWhereTheExactOneDoes) {
  const World exact = pressed(false);
  const World cut = pressed(true);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(cut.robot_pose(i).x_m, exact.robot_pose(i).x_m, 0.010) << i;
    EXPECT_NEAR(cut.robot_pose(i).y_m, exact.robot_pose(i).y_m, 0.020) << i;
    EXPECT_NEAR(cut.robot_velocity_m_s(i).y, 0.0, 0.03) << i;
    EXPECT_GT(cut.robot_up(i), 0.999) << i;
  }
}

// Placed 20 mm inside each other, they part, and not with a bang.
TEST(Crowd, WhatIsInsideAnotherComesOut) {
  const WorldConfig config = match_world(step_s);
  World world(config);
  for (std::size_t i = 0; i < 3; ++i) {
    world.place_robot(i, {.x_m = 0.13 * static_cast<double>(i), .y_m = 0.5, .heading_rad = 0.0});
  }
  world.place_ball({.position_m = {-2.0, 0.0}, .velocity_m_s = {}});
  for (int step = 0; step < 100; ++step) {
    world.step();
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_LT(std::abs(world.robot_velocity_m_s(i).x), 0.5);
    }
  }
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(robot_robot_depth_m(world.robot_pose(i - 1), world.robot_pose(i)), 0.005) << i;
  }
}

// A robot that pushes two others, which roll or stand across.
TEST(Crowd, CutItIsPushedAsTheExactOneIs) {
  for (const double across_rad : {0.0, 0.5 * std::numbers::pi}) {
    std::array<double, 2> pushed_m{};
    for (const bool cut : {false, true}) {
      World world({.robots = std::vector<RobotSpec>(3, robot_spec(Role::defender)),
                   .walls = true,
                   .step_s = step_s,
                   .crowds_are_cut = cut});
      world.place_ball({.position_m = {-2.0, 0.0}, .velocity_m_s = {}});
      world.place_robot(0, {.x_m = 0.0, .y_m = 0.0, .heading_rad = 0.0});
      world.place_robot(1, {.x_m = 0.2, .y_m = 0.0, .heading_rad = 0.0});
      world.place_robot(2, {.x_m = 0.4, .y_m = 0.0, .heading_rad = across_rad});
      drive(world, 0, 1.0, 1.0, 1.2);
      run(world, 1.0);
      pushed_m[cut ? 1 : 0] = world.robot_pose(2).x_m;
    }
    EXPECT_NEAR(pushed_m[1], pushed_m[0], 0.05) << across_rad;
  }
}

}  // namespace
}  // namespace striker::sil

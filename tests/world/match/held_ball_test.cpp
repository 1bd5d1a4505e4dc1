// SPDX-License-Identifier: Apache-2.0
// A ball held between a robot and a wall, or between robots, adds no energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/world/match/energy.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

// What a step may add without motors: springs of floor, axles and contact that were strained before, the ball's
// spin that becomes speed, and the push that takes a deep ball out (1 mJ). A ball of 18 g at 2.5 m/s has 57 mJ, a
// robot 5.5 J.
constexpr double tolerance_J = 0.02;

WorldConfig pair_config(double step_s, bool can_be_held) {
  return {.robots = {robot_spec(Role::forward), robot_spec(Role::defender)},
          .walls = true,
          .step_s = step_s,
          .ball_can_be_held = can_be_held};
}

double energy_J(const World& world, const WorldConfig& config) {
  double sum_J = ball_energy_J(world);
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    sum_J += robot_energy_J(world, i, config.robots[i]);
  }
  return sum_J;
}

// A tilted robot has been lifted by as much as its half side times the sine: what it may gain when it lands.
double tilt_J(const World& world, const WorldConfig& config) {
  constexpr double arm_m = 0.09;
  double sum_J = 0.0;
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    const double mass_kg = config.robots[i].body_mass_kg + 2.0 * config.robots[i].wheel_mass_kg;
    const double up = world.robot_up(i);
    sum_J += mass_kg * gravity_m_s2 * arm_m * std::sqrt(std::max(0.0, 1.0 - up * up));
  }
  return sum_J;
}

void coast(World& world) {
  for (std::size_t robot = 0; robot < 2; ++robot) {
    for (const Wheel wheel : wheels) {
      world.torque_wheel(robot, wheel, 0.0);
    }
  }
}

// A forward drives at the side wall, or the two at each other, until they are less than a ball apart; then the
// ball is put in between, as deep in one as in the other, and the motors are let go.
void pin_ball(World& world, Random& random) {
  const bool at_wall = random.uniform(0.0, 1.0) < 0.5;
  const double speed_m_s = random.uniform(0.0, 2.5);
  const double gap_m = 2.0 * ball_radius_m - random.uniform(0.0, 0.04);
  const double aside_m = random.uniform(-0.07, 0.07);
  const double slant_rad = random.uniform(-0.6, 0.6);
  const double end_m = at_wall ? field_half_width_m : 0.5 * gap_m;
  const double start_m = end_m - 0.6;
  world.place_robot(0, {.x_m = 0.0, .y_m = start_m, .heading_rad = 0.5 * std::numbers::pi + slant_rad});
  const Pose other = at_wall ? Pose{.x_m = 2.0, .y_m = -1.0, .heading_rad = 0.0}
                             : Pose{.x_m = random.uniform(-0.05, 0.05),
                                    .y_m = 0.5 * gap_m + 0.6,
                                    .heading_rad = -0.5 * std::numbers::pi + random.uniform(-0.3, 0.3)};
  world.place_robot(1, other);
  world.place_ball({.position_m = {-2.0, 0.0}, .velocity_m_s = {}});
  drive(world, 0, speed_m_s, speed_m_s, 0.4);
  drive(world, 1, at_wall ? 0.0 : speed_m_s, at_wall ? 0.0 : speed_m_s, 1.2);
  const auto face_y_m = [&world](std::size_t robot, double side) {
    return world.robot_pose(robot).y_m + side * 0.5 * robot_side_m;
  };
  const auto far_y_m = [&] { return at_wall ? field_half_width_m : face_y_m(1, -1.0); };
  for (int step = 0; step < 3000 && far_y_m() - face_y_m(0, 1.0) > gap_m; ++step) {
    world.step();
  }
  coast(world);
  world.place_ball({.position_m = {world.robot_pose(0).x_m + aside_m, 0.5 * (face_y_m(0, 1.0) + far_y_m())},
                    .velocity_m_s = {}});
}

double largest_rise_J(double step_s, std::uint64_t placements) {
  const WorldConfig config = pair_config(step_s, true);
  World world(config);
  double largest_J = 0.0;
  for (std::uint64_t i = 0; i < placements; ++i) {
    Random random(11, i, 0);
    pin_ball(world, random);
    double before_J = energy_J(world, config);
    for (int step = 0; step < 30; ++step) {
      before_J += tilt_J(world, config);
      world.step();
      const double after_J = energy_J(world, config);
      largest_J = std::max(largest_J, after_J - before_J);
      before_J = after_J;
    }
  }
  return largest_J;
}

TEST(HeldBall, ItsEnergyNeverRises) {
  EXPECT_LT(largest_rise_J(0.010, 400), tolerance_J);
  EXPECT_LT(largest_rise_J(0.001, 200), tolerance_J);
}

// A forward and a defender drive at each other, the ball somewhere in between.
double fastest_robot_m_s(bool can_be_held) {
  World world(pair_config(0.010, can_be_held));
  double fastest_m_s = 0.0;
  for (int place = 0; place < 11 * 13; ++place) {
    const int row = place / 11;
    world.place_robot(0, {.x_m = -0.5, .y_m = 0.0, .heading_rad = 0.0});
    world.place_robot(1, {.x_m = 0.5, .y_m = 0.02, .heading_rad = std::numbers::pi});
    world.place_ball({.position_m = {-0.05 + 0.01 * (place % 11), -0.06 + 0.01 * row}, .velocity_m_s = {}});
    drive(world, 0, 2.55, 2.55, 0.4);
    drive(world, 1, 2.1, 2.1, 1.2);
    for (int step = 0; step < 100; ++step) {
      world.step();
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec2 velocity = world.robot_velocity_m_s(i);
        fastest_m_s = std::max(fastest_m_s, std::hypot(velocity.x, velocity.y));
      }
    }
  }
  return fastest_m_s;
}

// What the switch is for: the second robot's limit is 2.1 m/s, the first one's 2.55.
TEST(HeldBall, ItThrowsNoRobotAsTheTableDoes) {
  EXPECT_LT(fastest_robot_m_s(true), 2.65);
  EXPECT_GT(fastest_robot_m_s(false), 3.2);
}

// The motors on: never more than their work, each rim's largest speed in the step at its ceiling.
TEST(HeldBall, MotorsAddNoMoreThanTheirWork) {
  for (const double step_s : {0.001, 0.010}) {
    const WorldConfig config = pair_config(step_s, true);
    World world(config);
    for (std::uint64_t i = 0; i < 200; ++i) {
      Random random(12, i, 0);
      pin_ball(world, random);
      double before_J = energy_J(world, config);
      for (int step = 0; step < 30; ++step) {
        double work_J = 0.0;
        const double tilted_J = tilt_J(world, config);
        std::array<double, 4> rims_m_s{};
        const auto rim_m_s = [&world](std::size_t k) {
          return std::abs(world.rim_speed_m_s(k / 2, wheels[k % 2]));
        };
        for (std::size_t k = 0; k < rims_m_s.size(); ++k) {
          rims_m_s[k] = rim_m_s(k);
        }
        drive(world, 0, 2.55, 2.55, 0.4);
        drive(world, 1, 2.1, 2.1, 1.2);
        world.step();
        for (std::size_t k = 0; k < rims_m_s.size(); ++k) {
          const RobotSpec& spec = config.robots[k / 2];
          work_J +=
              spec.max_wheel_torque_Nm / spec.wheel_radius_m * step_s * std::max(rims_m_s[k], rim_m_s(k));
        }
        const double after_J = energy_J(world, config);
        ASSERT_LT(after_J, before_J + tilted_J + work_J + tolerance_J)
            << "placement " << i << " step " << step;
        before_J = after_J;
      }
    }
  }
}

// A robot that drives at a ball on the wall is stopped by it, and stays.
TEST(HeldBall, ItStopsARobot) {
  World world(pair_config(0.010, true));
  world.place_robot(0, {.x_m = -0.04, .y_m = 1.7, .heading_rad = 1.4});
  world.place_robot(1, {.x_m = 2.0, .y_m = 0.0, .heading_rad = 0.0});
  world.place_ball({.position_m = {0.0, 2.1}, .velocity_m_s = {}});
  for (int step = 0; step < 100; ++step) {
    drive(world, 0, 2.55, 2.55, 0.4);
    world.step();
    const Vec2 velocity = world.robot_velocity_m_s(0);
    ASSERT_LT(std::hypot(velocity.x, velocity.y), 2.7) << step;
    ASSERT_LT(world.robot_pose(0).y_m, field_half_width_m - 0.075) << step;
  }
}

// Robots that were taken off hold nothing.
TEST(HeldBall, ARemovedRobotHoldsNone) {
  World world(pair_config(0.010, true));
  world.remove_robot(0, {.x_m = 0.0, .y_m = 2.2, .heading_rad = 0.0});
  world.remove_robot(1, {.x_m = 0.0, .y_m = 2.2, .heading_rad = 0.3});
  world.place_ball({.position_m = {0.0, 1.5}, .velocity_m_s = {0.0, 3.0}});
  run(world, 0.4);
  EXPECT_LT(world.ball().velocity_m_s.y, -1.9);
}

// A ball put onto a robot comes off it slowly.
TEST(HeldBall, PutIntoARobotItIsNotSpatOut) {
  for (const double step_s : {0.001, 0.010}) {
    World world(pair_config(step_s, true));
    world.place_robot(1, {.x_m = 2.0, .y_m = 0.0, .heading_rad = 0.0});
    for (const Vec2 place : {Vec2{0.0, 0.0}, Vec2{0.05, 0.0}, Vec2{-0.03, 0.06}}) {
      world.place_robot(0, {});
      world.place_ball({.position_m = place, .velocity_m_s = {}});
      for (int step = 0; step < 300; ++step) {
        world.step();
        ASSERT_LT(ball_energy_J(world), 0.018) << "step " << step;  // lifted onto the roof: 16 mJ
        ASSERT_GT(world.ball_in_space().position_m.z, ball_radius_m - 0.0011);
        const Vec2 velocity = world.robot_velocity_m_s(0);
        ASSERT_LT(std::hypot(velocity.x, velocity.y), 0.1);
      }
    }
  }
}

// A kick on the open floor hardly feels the switch.
TEST(HeldBall, AKickIsTheSameWithIt) {
  WorldConfig held = kick_world(0.010);
  held.ball_can_be_held = true;
  World with(held);
  World without(kick_world(0.010));
  for (std::uint64_t i = 0; i < 100; ++i) {
    const KickOutcome a = play(with, draw_kick(2, i, PoseMode::anywhere), random_actions(i));
    const KickOutcome b = play(without, draw_kick(2, i, PoseMode::anywhere), random_actions(i));
    EXPECT_NEAR(a.ball_speed_m_s, b.ball_speed_m_s, 0.02) << i;
    EXPECT_NEAR(a.ball_angle_rad, b.ball_angle_rad, 0.02) << i;
  }
}

}  // namespace
}  // namespace striker::sil

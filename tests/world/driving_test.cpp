// SPDX-License-Identifier: Apache-2.0
// A robot on its wheels: what the motors ask for is what the body does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

// Rim force over the mass to be moved: the wheels' spin counts half their mass.
double acceleration_m_s2(double torque_Nm) {
  const RobotSpec spec = robot_spec(Role::forward);
  return 2.0 * torque_Nm / spec.wheel_radius_m / (spec.body_mass_kg + 3.0 * spec.wheel_mass_kg);
}

TEST(Driving, ForwardIsLimitedByTheTorqueCeiling) {
  for (const double ceiling_Nm : {0.1, 0.2, 0.4}) {
    World world(kick_world(0.010));
    drive(world, 0, 2.55, 2.55, ceiling_Nm);
    run(world, 0.1);
    EXPECT_NEAR(world.robot_velocity_m_s(0).x / 0.1, acceleration_m_s2(ceiling_Nm),
                0.03 * acceleration_m_s2(ceiling_Nm))
        << ceiling_Nm;
  }
}

TEST(Driving, ForwardReachesItsTopSpeed) {
  World world(kick_world(0.010));
  drive_straight(world, 2.55);
  run(world, 0.3);
  EXPECT_GE(world.robot_velocity_m_s(0).x, 2.45);
  run(world, 0.7);
  EXPECT_NEAR(world.robot_velocity_m_s(0).x, 2.55, 0.02);
  EXPECT_NEAR(world.rim_speed_m_s(0, Wheel::left), 2.55, 0.01);
}

TEST(Driving, KeepsItsHeadingThroughHardReversals) {
  World world(kick_world(0.010));
  world.place_robot(0, {});
  for (const double speed_m_s : {2.55, -2.55, 2.55, 0.0, -2.55}) {
    drive_straight(world, speed_m_s);
    run(world, 0.8);
    EXPECT_NEAR(world.robot_velocity_m_s(0).x, speed_m_s, 0.02);
  }
  EXPECT_NEAR(world.robot_pose(0).heading_rad, 0.0, 1e-5);
  EXPECT_NEAR(world.robot_pose(0).y_m, 0.0, 1e-4);
}

TEST(Driving, TorqueActsAsItIs) {
  for (const double torque_Nm : {-0.3, -0.1, 0.05, 0.4}) {
    World world(kick_world(0.001));
    world.torque_wheel(0, Wheel::left, torque_Nm);
    world.torque_wheel(0, Wheel::right, torque_Nm);
    run(world, 0.1);
    EXPECT_NEAR(world.robot_velocity_m_s(0).x / 0.1, acceleration_m_s2(torque_Nm),
                0.03 * std::abs(acceleration_m_s2(torque_Nm)))
        << torque_Nm;
  }
}

TEST(Driving, CoastingLosesTwentyPerCentASecond) {
  World world(kick_world(0.010));
  drive_straight(world, 2.0);
  run(world, 1.0);
  const double before_m_s = world.robot_velocity_m_s(0).x;
  world.torque_wheel(0, Wheel::left, 0.0);
  world.torque_wheel(0, Wheel::right, 0.0);
  run(world, 1.0);
  EXPECT_NEAR(world.robot_velocity_m_s(0).x, 0.8 * before_m_s, 0.01);
}

TEST(Driving, OppositeWheelsTurnOnTheSpot) {
  for (const double rim_speed_m_s : {-1.0, 0.3, 1.0}) {
    World world(kick_world(0.001));
    world.place_robot(0, {.x_m = 1.0, .y_m = 0.5, .heading_rad = 0.2});
    drive(world, 0, -rim_speed_m_s, rim_speed_m_s, 0.4);
    run(world, 0.3);
    const double before_rad = world.robot_pose(0).heading_rad;
    run(world, 0.1);
    const double rate_rad_s =
        std::remainder(world.robot_pose(0).heading_rad - before_rad, 2.0 * std::numbers::pi) / 0.1;
    EXPECT_NEAR(rate_rad_s, 2.0 * rim_speed_m_s / robot_spec(Role::forward).axle_length_m,
                0.03 * std::abs(rate_rad_s));
    EXPECT_NEAR(world.robot_pose(0).x_m, 1.0, 1e-3);
    EXPECT_NEAR(world.robot_pose(0).y_m, 0.5, 1e-3);
  }
}

TEST(Driving, WallsStopARobot) {
  World world({.robots = {robot_spec(Role::forward)}, .walls = true, .step_s = 0.010});
  for (const double heading_rad : {0.5 * std::numbers::pi, -0.5 * std::numbers::pi}) {
    world.place_robot(0, {.x_m = 1.0, .y_m = 0.0, .heading_rad = heading_rad});
    drive_straight(world, 2.55);
    run(world, 3.0);
    EXPECT_GT(std::abs(world.robot_pose(0).y_m), 2.1);
    EXPECT_LT(std::abs(world.robot_pose(0).y_m), 2.325);
  }
}

TEST(Driving, RobotsStopEachOther) {
  World world(
      {.robots = {robot_spec(Role::forward), robot_spec(Role::forward)}, .walls = false, .step_s = 0.010});
  world.place_robot(0, {.x_m = -0.5, .y_m = 0.0, .heading_rad = 0.0});
  world.place_robot(1, {.x_m = 0.5, .y_m = 0.0, .heading_rad = std::numbers::pi});
  world.place_ball({.position_m = {0.0, 3.0}, .velocity_m_s = {}});
  drive(world, 0, 1.0, 1.0, 0.4);
  drive(world, 1, 1.0, 1.0, 0.4);
  run(world, 2.0);
  EXPECT_GT(world.robot_pose(1).x_m - world.robot_pose(0).x_m, 0.9 * robot_side_m);
}

TEST(Driving, APlacedRobotStandsStill) {
  World world(kick_world(0.010));
  drive_straight(world, 2.55);
  run(world, 0.5);
  world.place_robot(0, {.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.5});
  run(world, 2.0);
  EXPECT_NEAR(world.robot_pose(0).x_m, 1.0, 1e-6);
  EXPECT_NEAR(world.robot_pose(0).y_m, 2.0, 1e-6);
  EXPECT_NEAR(world.robot_pose(0).heading_rad, 0.5, 1e-6);
}

TEST(Driving, RolesDifferInSpeed) {
  for (const Role role : {Role::goalkeeper, Role::defender, Role::forward}) {
    const RobotSpec spec = robot_spec(role);
    World world({.robots = {spec}, .walls = false, .step_s = 0.010});
    drive(world, 0, spec.max_rim_speed_m_s, spec.max_rim_speed_m_s, spec.max_wheel_torque_Nm);
    run(world, 0.5);
    EXPECT_NEAR(world.robot_velocity_m_s(0).x, spec.max_rim_speed_m_s, 0.03);
  }
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What a referee sees and does beside placing: tilt, turn, the ball in space, touches, robots taken off.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

WorldConfig match_of(std::size_t robots) {
  return {
      .robots = std::vector<RobotSpec>(robots, robot_spec(Role::forward)), .walls = true, .step_s = 0.010};
}

// Inside an end block, where the sent-out robots wait.
constexpr Pose slot = {.x_m = 4.2, .y_m = 1.5, .heading_rad = 0.5 * std::numbers::pi};

TEST(RefereeInterface, AStandingRobotIsUprightAndATurningOneTellsItsRate) {
  World world(match_of(1));
  world.place_robot(0, {});
  drive(world, 0, -0.2, 0.2, 0.4);
  run(world, 1.0);
  EXPECT_NEAR(world.robot_up(0), 1.0, 1e-6);
  const double before_rad = world.robot_pose(0).heading_rad;
  world.step();
  const double turned_rad = world.robot_pose(0).heading_rad - before_rad;
  EXPECT_NEAR(world.yaw_rate_rad_s(0), std::remainder(turned_rad, 2.0 * std::numbers::pi) / 0.010, 0.02);
  EXPECT_GT(world.yaw_rate_rad_s(0), 2.0);
}

TEST(RefereeInterface, ADroppedBallFallsAsGravitySaysAndLies) {
  World world(match_of(1));
  world.drop_ball({0.5, -0.25}, 0.45);
  EXPECT_EQ(world.ball_in_space().position_m, (Vec3{0.5, -0.25, 0.45}));
  EXPECT_EQ(world.ball_in_space().velocity_m_s, Vec3{});
  run(world, 0.2);
  EXPECT_NEAR(world.ball_in_space().velocity_m_s.z, -9.81 * 0.2, 0.08);  // damping
  EXPECT_NEAR(world.ball_in_space().position_m.z, 0.45 - 0.5 * 9.81 * 0.04, 0.02);
  run(world, 1.0);
  EXPECT_NEAR(world.ball_in_space().position_m.z, ball_radius_m, 1e-4);
  EXPECT_NEAR(world.ball_in_space().position_m.x, 0.5, 1e-6);
  EXPECT_NEAR(world.ball_in_space().velocity_m_s.z, 0.0, 1e-3);
}

TEST(RefereeInterface, ABallIsNotDroppedBelowTheFloor) {
  World world(match_of(1));
  world.drop_ball({}, -1.0);
  EXPECT_NEAR(world.ball_in_space().position_m.z, ball_radius_m, 1e-6);
}

TEST(RefereeInterface, ATouchIsRememberedUntilItIsCleared) {
  World world(match_of(2));
  world.place_robot(0, {.x_m = 0.0, .y_m = 0.0, .heading_rad = 0.0});
  world.place_robot(1, {.x_m = 2.0, .y_m = 1.0, .heading_rad = 0.0});
  world.place_ball({.position_m = {0.2, 0.0}, .velocity_m_s = {-2.0, 0.0}});
  run(world, 0.3);
  EXPECT_FALSE(world.ball_contact(0));  // of the last step only
  EXPECT_TRUE(world.touched_ball(0));
  EXPECT_FALSE(world.touched_ball(1));
  world.clear_touches();
  EXPECT_FALSE(world.touched_ball(0));
}

TEST(RefereeInterface, ARemovedRobotStaysWhereItWasPutAndDrivesNot) {
  World world(match_of(2));
  drive(world, 0, 2.0, -2.0, 0.4);
  run(world, 0.3);
  world.remove_robot(0, slot);
  EXPECT_TRUE(world.is_removed(0));
  EXPECT_FALSE(world.is_removed(1));
  drive(world, 0, 2.0, 1.0, 0.4);
  run(world, 0.5);
  world.torque_wheel(0, Wheel::left, 0.4);
  run(world, 0.5);
  EXPECT_DOUBLE_EQ(world.robot_pose(0).x_m, slot.x_m);
  EXPECT_DOUBLE_EQ(world.robot_pose(0).y_m, slot.y_m);
  EXPECT_NEAR(world.robot_pose(0).heading_rad, slot.heading_rad, 1e-12);
  EXPECT_EQ(world.robot_velocity_m_s(0), Vec2{});
  EXPECT_EQ(world.rim_speed_m_s(0, Wheel::left), 0.0);
}

TEST(RefereeInterface, ARemovedRobotIsInNobodysWay) {
  World world(match_of(2));
  world.place_robot(1, {.x_m = -1.0, .y_m = 0.0, .heading_rad = 0.0});
  world.remove_robot(0, {.x_m = -0.5, .y_m = 0.0, .heading_rad = 0.0});
  world.place_ball({.position_m = {0.0, 0.0}, .velocity_m_s = {-1.0, 0.0}});
  drive(world, 1, 0.0, 0.0, 0.4);
  run(world, 0.5);
  EXPECT_LT(world.ball().position_m.x, -0.4);
  EXPECT_FALSE(world.touched_ball(0));
  drive(world, 1, 1.0, 1.0, 0.4);
  run(world, 1.5);
  EXPECT_GT(world.robot_pose(1).x_m, -0.2);
}

TEST(RefereeInterface, PutBackItIsAsIfItHadNeverBeenAway) {
  World away(match_of(2));
  World always(match_of(2));
  away.remove_robot(0, slot);
  away.torque_wheel(0, Wheel::right, 0.4);
  run(away, 0.3);
  for (World* world : {&away, &always}) {
    world->place_robot(0, {.x_m = 0.3, .y_m = 0.1, .heading_rad = 0.4});
    world->place_robot(1, {.x_m = 0.5, .y_m = 0.1, .heading_rad = -2.0});
    world->place_ball({.position_m = {0.4, 0.3}, .velocity_m_s = {0.0, -1.0}});
    for (std::size_t i = 0; i < 2; ++i) {
      drive(*world, i, 1.0, 1.1, 0.4);
    }
    run(*world, 0.5);
  }
  EXPECT_FALSE(away.is_removed(0));
  EXPECT_EQ(away.state_hash(), always.state_hash());
}

TEST(RefereeInterface, TheHashTellsTheSmallestDifferenceOfAnyBody) {
  World world(match_of(3));
  const std::uint64_t before = world.state_hash();
  EXPECT_EQ(World(match_of(3)).state_hash(), before);
  const Pose pose = world.robot_pose(2);
  const Pose moved = {.x_m = std::nextafter(pose.x_m, 0.0), .y_m = pose.y_m, .heading_rad = 0.0};
  world.place_robot(2, moved);
  EXPECT_NE(world.state_hash(), before);
  world.place_robot(2, pose);
  EXPECT_EQ(world.state_hash(), before);
  world.place_ball({.position_m = {}, .velocity_m_s = {1e-12, 0.0}});
  EXPECT_NE(world.state_hash(), before);
  world.place_ball({});
  world.remove_robot(1, world.robot_pose(1));
  EXPECT_NE(world.state_hash(), before);
}

}  // namespace
}  // namespace striker::sil

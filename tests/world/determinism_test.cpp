// SPDX-License-Identifier: Apache-2.0
// The same calls give the same bits, whatever a world has been through and whatever other worlds do.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <cstdarg>
#include <cstring>

#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

using Trace = std::vector<double>;

void record(const World& world, std::size_t robots, Trace& trace) {
  for (std::size_t i = 0; i < robots; ++i) {
    const Pose pose = world.robot_pose(i);
    const Vec2 velocity = world.robot_velocity_m_s(i);
    trace.insert(trace.end(), {pose.x_m, pose.y_m, pose.heading_rad, velocity.x, velocity.y,
                               world.rim_speed_m_s(i, Wheel::left), world.rim_speed_m_s(i, Wheel::right),
                               world.ball_contact(i) ? world.ball_contact(i)->x : -2.0});
  }
  const BallState ball = world.ball();
  trace.insert(trace.end(), {ball.position_m.x, ball.position_m.y, ball.velocity_m_s.x, ball.velocity_m_s.y});
}

bool same_bits(const Trace& a, const Trace& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void place_all(World& world, std::size_t robots) {
  for (std::size_t i = 0; i < robots; ++i) {
    const double place = static_cast<double>(i);
    world.place_robot(i, {.x_m = 0.4 * place - 1.8, .y_m = 0.1 * place, .heading_rad = place});
  }
  world.place_ball({.position_m = {0.1, -0.5}, .velocity_m_s = {0.5, 1.5}});
}

void step_recorded(World& world, std::size_t robots, int step, Trace& trace) {
  for (std::size_t i = 0; i < robots; ++i) {
    const double wave = std::sin(0.05 * step + static_cast<double>(i));
    if (step % 100 < 50) {
      drive(world, i, 2.0 * wave, 1.5, 0.4);
    } else {
      world.torque_wheel(i, Wheel::left, 0.3 * wave);
      world.torque_wheel(i, Wheel::right, 0.2);
    }
  }
  world.step();
  record(world, robots, trace);
}

Trace played(World& world, std::size_t robots) {
  Trace trace;
  place_all(world, robots);
  for (int step = 0; step < 200; ++step) {
    step_recorded(world, robots, step, trace);
  }
  return trace;
}

TEST(Determinism, APlacedWorldIsAsNew) {
  for (const std::size_t robots : {1U, 4U, 10U}) {
    const WorldConfig config{
        .robots = std::vector<RobotSpec>(robots, robot_spec(Role::forward)), .walls = true, .step_s = 0.010};
    World fresh(config);
    World used(config);
    place_all(used, robots);
    for (std::size_t i = 0; i < robots; ++i) {
      drive(used, i, 2.55, 1.0 - static_cast<double>(i), 0.4);
    }
    run(used, 3.0);
    EXPECT_TRUE(same_bits(played(fresh, robots), played(used, robots))) << robots << " robots";
  }
}

TEST(Determinism, APlacedRobotForgetsItsContact) {
  World world(kick_world(0.010));
  world.place_robot(0, {});
  world.place_ball({.position_m = {0.11, 0.0}, .velocity_m_s = {}});
  world.step();
  ASSERT_TRUE(world.ball_contact(0));
  world.place_robot(0, {});
  EXPECT_FALSE(world.ball_contact(0));
}

TEST(Determinism, WorldsDoNotTouchEachOther) {
  const WorldConfig config{
      .robots = {robot_spec(Role::forward), robot_spec(Role::goalkeeper)}, .walls = true, .step_s = 0.010};
  World alone(config);
  const Trace expected = played(alone, 2);
  World a(config);
  World b(kick_world(0.001));
  Trace trace;
  place_all(a, 2);
  for (int step = 0; step < 200; ++step) {
    step_recorded(a, 2, step, trace);
    drive_straight(b, 2.55);
    b.step();
    const World passing(kick_world(0.010));
  }
  EXPECT_TRUE(same_bits(expected, trace));
}

TEST(Determinism, AnEpisodeAloneEqualsItAfterAThousandOthers) {
  World used(kick_world(0.010));
  for (std::uint64_t i = 0; i < 1'000; ++i) {
    static_cast<void>(play(used, draw_kick(2, i, PoseMode::anywhere), random_actions(i)));
  }
  for (std::uint64_t i = 1'000; i < 1'050; ++i) {
    World fresh(kick_world(0.010));
    const KickOutcome a = play(fresh, draw_kick(2, i, PoseMode::anywhere), random_actions(i));
    const KickOutcome b = play(used, draw_kick(2, i, PoseMode::anywhere), random_actions(i));
    EXPECT_EQ(a.reward, b.reward) << i;
    EXPECT_EQ(a.theta_contact_rad, b.theta_contact_rad) << i;
    EXPECT_EQ(a.ball_speed_m_s, b.ball_speed_m_s) << i;
    EXPECT_EQ(a.ball_angle_rad, b.ball_angle_rad) << i;
  }
}

TEST(Determinism, TenRobotsStayOnTheField) {
  World world(
      {.robots = std::vector<RobotSpec>(10, robot_spec(Role::forward)), .walls = true, .step_s = 0.010});
  place_all(world, 10);
  Trace trace;
  for (int step = 0; step < 500; ++step) {
    step_recorded(world, 10, step, trace);
  }
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(std::abs(world.robot_pose(i).x_m), 4.35);
    EXPECT_LT(std::abs(world.robot_pose(i).y_m), 2.325);
  }
}

int ode_messages = 0;

TEST(Determinism, TheSolverNeverGivesUp) {
  dMessageFunction* before = dGetMessageHandler();
  dSetMessageHandler([](int, const char*, va_list) { ++ode_messages; });
  World coarse(kick_world(0.010));
  for (std::uint64_t i = 0; i < 500; ++i) {
    static_cast<void>(play(coarse, draw_kick(1, i, PoseMode::origin), random_actions(i)));
  }
  for (std::uint64_t i = 0; i < 1'000; ++i) {
    Random random(1, i, 0);
    coarse.place_robot(0, {.x_m = 0.0, .y_m = 0.0, .heading_rad = random.uniform(-3.0, 3.0)});
    drive_straight(coarse, random.uniform(2.1, 2.3));
    run(coarse, 0.030);
  }
  // Side hits on a standing robot.
  World fine(kick_world(0.001));
  for (std::uint64_t i = 0; i < 1'000; ++i) {
    Random random(2, i, 0);
    fine.place_robot(0, {});
    fine.place_ball({.position_m = {random.uniform(-0.08, 0.08), 0.2},
                     .velocity_m_s = {random.uniform(-1.0, 1.0), random.uniform(-3.0, -1.0)}});
    run(fine, 0.100);
  }
  dSetMessageHandler(before);
  EXPECT_EQ(ode_messages, 0);
}

TEST(Determinism, RefusesAnImpossibleWorld) {
  EXPECT_THROW(World({.robots = {}}), std::invalid_argument);
  EXPECT_THROW(World({.robots = std::vector<RobotSpec>(11, robot_spec(Role::forward))}),
               std::invalid_argument);
  EXPECT_THROW(World(kick_world(0.0)), std::invalid_argument);
}

}  // namespace
}  // namespace striker::sil

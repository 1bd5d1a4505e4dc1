// SPDX-License-Identifier: Apache-2.0
// How the ball leaves is the fast world's doing to the last bit, and never more than what is said of it before.
#include "training/line/leaving_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sil/task/kick_task.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/planar_collision.hpp"
#include "training/line/line_play.hpp"

namespace striker::training {
namespace {

struct Contact {
  LineState robot;
  sil::BallState ball;
  Push push;
};

// Front, rear and side hits, corners, balls that are caught up with; as deep as a step's movement makes them.
class RandomContacts {
 public:
  explicit RandomContacts(unsigned seed) : random_(seed) {}

  Contact next(double top_m_s) {
    constexpr double half_side_m = 0.5 * sil::robot_side_m;
    const double speed_m_s = between(0.3, 3.0);
    const double direction_rad = between(-std::numbers::pi, std::numbers::pi);
    const sil::Vec2 ball_m_s{speed_m_s * std::cos(direction_rad), speed_m_s * std::sin(direction_rad)};
    Contact contact{.robot = {.position_m = between(-1.0, 1.0), .speed_m_s = between(-top_m_s, top_m_s)},
                    .ball = {.position_m = {}, .velocity_m_s = ball_m_s},
                    .push = {.set_point_m_s = top_m_s * std::round(between(-1.5, 1.5)),
                             .last_set_point_m_s = top_m_s * std::round(between(-1.5, 1.5)),
                             .late_steps = static_cast<int>(between(0.0, 4.0))}};
    const double y_m = between(-half_side_m - sil::ball_radius_m, half_side_m + sil::ball_radius_m);
    const double beside_m = std::max(std::abs(y_m) - half_side_m, 0.0);
    const double reach_m =
        half_side_m + std::sqrt(std::max(0.0, sil::ball_radius_m * sil::ball_radius_m - beside_m * beside_m));
    const double closing_m_s = std::abs(contact.robot.speed_m_s - ball_m_s.x);
    const double depth_m = between(0.0, std::min(reach_m, physics_step_s * closing_m_s));
    const double ahead_m = reach_m - depth_m;
    contact.ball.position_m = {contact.robot.position_m + (between(0.0, 1.0) < 0.7 ? ahead_m : -ahead_m),
                               y_m};
    return contact;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }

  std::mt19937 random_;
};

// All eleven steps with the robot.
sil::Vec2 stepped(const Bodies& bodies, const Contact& contact) {
  sil::PlanarCollision collision(
      {.walls = false, .step_s = physics_step_s, .ball_kept_after_1_s = bodies.ball_kept_after_1_s},
      bodies.robot);
  sil::PlanarRobot robot =
      sil::planar_robot({.x_m = contact.robot.position_m, .y_m = 0.0, .heading_rad = 0.0});
  robot.velocity_m_s = {contact.robot.speed_m_s, 0.0};
  sil::BallState ball = contact.ball;
  collision.begin(robot, ball);
  for (int step = 0; step < 11; ++step) {
    const auto& [then_m_s, former_m_s, one_before_m_s, late_steps] = contact.push;
    const sil::WheelServo servo{.rim_speed_m_s = step < late_steps ? former_m_s : then_m_s,
                                .torque_ceiling_Nm = bodies.torque_ceiling_Nm};
    collision.step({servo, servo});
  }
  collision.read(robot, ball);
  return ball.velocity_m_s;
}

// Of other robots and balls in turn: none leaves a trace.
TEST(LeavingBall, IsTheCollisionsToTheLastBit) {
  RandomContacts contacts(1);
  const Bodies nominal = bodies_of(core::forward);
  const Bodies heavy = bodies_of(core::forward, {.mass_scale = 1.3, .torque_scale = 0.7});
  const Bodies slow_ball = bodies_of(core::goalkeeper, {.ball_damping_scale = 1.5});
  for (int i = 0; i < 600; ++i) {
    const Contact contact = contacts.next(2.55);
    for (const Bodies& bodies : {nominal, heavy, slow_ball}) {
      const sil::Vec2 left = leaving_ball_m_s(bodies, contact.robot, contact.ball, contact.push);
      const sil::Vec2 expected = stepped(bodies, contact);
      ASSERT_EQ(left.x, expected.x) << i;
      ASSERT_EQ(left.y, expected.y) << i;
    }
  }
}

TEST(LeavingBall, ALateDecisionActsLate) {
  const Bodies bodies = bodies_of(core::forward);
  const LineState robot{.position_m = 0.0, .speed_m_s = 0.3};
  const sil::BallState ball{.position_m = {0.124, 0.0}, .velocity_m_s = {0.25, 0.0}};
  const auto speed_m_s = [&](const Push& push) { return leaving_ball_m_s(bodies, robot, ball, push).x; };
  const double at_once = speed_m_s({.set_point_m_s = 2.55});
  const double late = speed_m_s({.set_point_m_s = 2.55, .last_set_point_m_s = 0.0, .late_steps = 3});
  EXPECT_GT(at_once, late + 0.05);
  EXPECT_EQ(speed_m_s({.set_point_m_s = 2.55, .last_set_point_m_s = -2.55, .late_steps = 0}), at_once);
}

// The search drops, and the planner passes over, what the bound says cannot pay. One contact in 100 that pays well is a
// little above it.
TEST(LeavingBall, PaysHardlyMoreThanTheBound) {
  for (const core::RobotDescription& description : {core::forward, core::goalkeeper}) {
    RandomContacts contacts(2);
    constexpr Waited waited{.reward_a_decision = -0.1, .decisions = 10};
    const LineDrive drive = line_drive(description, sil::KickReward::aimed);
    int well_paid = 0;
    int above = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Contact contact = contacts.next(drive.top_speed_m_s);
      const auto& [robot, ball, push] = contact;
      const double reward = aimed_contact_reward(drive.bodies, robot, ball, push, waited);
      const double most = most_aimed_reward(drive.bodies, robot.speed_m_s, ball, waited);
      ASSERT_LE(reward, most + 0.4) << i;
      above += reward > most ? 1 : 0;
      ASSERT_LE(least_speed_for_m_s(drive.bodies, most - 1e-9, ball, waited), robot.speed_m_s) << i;
      ASSERT_EQ(aimed_contact_reward(drive.bodies, robot, ball, push, waited, most - 1e-9), reward) << i;
      ASSERT_EQ(aimed_contact_reward(drive.bodies, robot, ball, push, waited, most), most) << i;
      well_paid += reward > 3.0 ? 1 : 0;
    }
    EXPECT_GT(well_paid, 1000);
    EXPECT_LT(above, well_paid / 100);
  }
}

}  // namespace
}  // namespace striker::training

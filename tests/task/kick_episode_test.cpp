// SPDX-License-Identifier: Apache-2.0
// What an episode is worth, on hand-made situations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

constexpr double pi = std::numbers::pi;
const Actions forward(kick_decisions, 1);
const Actions stop(kick_decisions, 0);
const Actions backward(kick_decisions, -1);

KickStart resting_ball(double x_m, double y_m) {
  return {.robot = {}, .ball = {.position_m = {x_m, y_m}, .velocity_m_s = {}}};
}

TEST(KickEpisode, WithoutContactItIsWorthMinusFour) {
  World world(kick_world(0.010));
  KickEpisode episode;
  episode.begin(world, resting_ball(0.0, 2.0));
  for (int decision = 0; decision < kick_decisions; ++decision) {
    episode.step(world);
    EXPECT_EQ(episode.end_decision(), -0.1);
  }
  EXPECT_EQ(episode.end_decision(), 0.0);
  const KickOutcome& outcome = episode.outcome();
  EXPECT_FALSE(outcome.contact);
  EXPECT_EQ(outcome.contact_decision, -1);
  EXPECT_NEAR(outcome.reward, -4.0, 1e-12);
  EXPECT_FALSE(outcome.ball_measured);
  EXPECT_FALSE(outcome.kicked);
}

TEST(KickEpisode, HeadOnAtFullSpeedPaysBothParts) {
  for (const double step_s : {0.001, 0.010}) {
    World world(kick_world(step_s));
    const KickOutcome outcome = play(world, resting_ball(1.5, 0.0), forward);
    ASSERT_TRUE(outcome.contact);
    EXPECT_NEAR(outcome.theta_contact_rad, 0.0, 1e-4);
    EXPECT_NEAR(outcome.v_contact_m_s, 2.55, 0.02);
    EXPECT_TRUE(outcome.front_face);
    EXPECT_NEAR(outcome.reward,
                -0.1 * outcome.contact_decision + 3.0 * std::cos(outcome.theta_contact_rad) +
                    3.92 * outcome.v_contact_m_s,
                1e-12);
    EXPECT_TRUE(outcome.ball_measured);
    // Restitution 0.8 off a body a hundred times heavier.
    EXPECT_NEAR(outcome.ball_speed_m_s, 1.8 * 2.55, 0.4);
    EXPECT_NEAR(outcome.ball_angle_rad, 0.0, 0.01);
    EXPECT_TRUE(outcome.kicked);
  }
}

// On the bus the decisions go on: the sum has it as soon as the ball is measured.
TEST(KickEpisode, AnAimedContactIsPaidWhenTheBallIsMeasured) {
  World world(kick_world(0.010));
  KickEpisode episode({.reward = KickReward::aimed});
  episode.begin(world, resting_ball(1.0, 0.02));
  drive_straight(world, 2.55);
  double told = 0.0;
  double waited = 0.0;
  for (int decision = 0; decision < kick_decisions; ++decision) {
    const bool before = episode.outcome().contact;
    for (int step = 0; step < 5; ++step) {
      episode.step(world);
    }
    told += episode.end_decision();
    waited += before || episode.outcome().contact ? 0.0 : -0.1;
  }
  const KickOutcome& outcome = episode.outcome();
  ASSERT_TRUE(outcome.ball_measured);
  const double along_m_s = outcome.ball_speed_m_s * std::cos(outcome.ball_angle_rad);
  const double across_m_s = outcome.ball_speed_m_s * std::sin(outcome.ball_angle_rad);
  EXPECT_NEAR(told, waited, 1e-12);
  EXPECT_NEAR(outcome.reward, waited + 2.0 * (along_m_s - std::abs(across_m_s)), 1e-12);
  EXPECT_GT(outcome.reward, 7.0);
}

TEST(KickEpisode, WhatAnAimedKickPays) {
  EXPECT_NEAR(aimed_reward({.x = 4.0, .y = 1.0}, 0.0), 6.0, 1e-12);
  EXPECT_NEAR(aimed_reward({.x = 4.0, .y = -1.0}, 0.0), 6.0, 1e-12);
  EXPECT_NEAR(aimed_reward({.x = -1.0, .y = 4.0}, 0.5 * pi), 6.0, 1e-12);
  EXPECT_NEAR(aimed_reward({.x = -1.0, .y = 0.0}, 0.0), -2.0, 1e-12);
  EXPECT_EQ(aimed_reward({.x = -3.0, .y = 0.0}, 0.0), -4.0);
}

TEST(KickEpisode, BackwardContactCostsAndIsNoKick) {
  World world(kick_world(0.010));
  const KickOutcome outcome = play(world, resting_ball(-1.5, 0.0), backward);
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(std::abs(outcome.theta_contact_rad), pi, 1e-4);
  EXPECT_NEAR(outcome.v_contact_m_s, -2.55, 0.02);
  EXPECT_FALSE(outcome.front_face);
  EXPECT_FALSE(outcome.kicked);
  EXPECT_LT(outcome.reward, -12.0);
}

TEST(KickEpisode, ThetaIsTheBearingOfTheBallAtTheContact) {
  World world(kick_world(0.001));
  for (const double offset_m : {-0.06, -0.03, 0.03, 0.06}) {
    const KickOutcome outcome = play(world, resting_ball(1.0, offset_m), forward);
    ASSERT_TRUE(outcome.contact);
    // Touching the front face, which lies half a side ahead of the centre.
    EXPECT_NEAR(outcome.theta_contact_rad, std::atan2(offset_m, 0.5 * robot_side_m + ball_radius_m), 0.01);
    EXPECT_TRUE(outcome.front_face);
  }
}

TEST(KickEpisode, ASideHitIsNotTheFrontFace) {
  World world(kick_world(0.010));
  for (const double side : {-1.0, 1.0}) {
    const KickStart start = {.robot = {},
                             .ball = {.position_m = {0.0, side * 1.0}, .velocity_m_s = {0.0, side * -1.5}}};
    const KickOutcome outcome = play(world, start, stop);
    ASSERT_TRUE(outcome.contact);
    EXPECT_NEAR(outcome.theta_contact_rad, side * 0.5 * pi, 0.01);
    EXPECT_NEAR(outcome.v_contact_m_s, 0.0, 1e-6);
    EXPECT_FALSE(outcome.front_face);
    EXPECT_FALSE(outcome.kicked);
  }
}

// A ball that comes to a standing robot `after_s` after the start.
KickStart arriving_ball(double after_s) {
  constexpr double damping_per_s = 0.22314;
  const double way_m = 1.0 * (1.0 - std::exp(-damping_per_s * after_s)) / damping_per_s;
  const double x_m = 0.5 * robot_side_m + ball_radius_m + way_m;
  return {.robot = {}, .ball = {.position_m = {x_m, 0.0}, .velocity_m_s = {-1.0, 0.0}}};
}

TEST(KickEpisode, AContactAfterTheLastDecisionDoesNotCount) {
  for (const double step_s : {0.001, 0.010}) {
    World world(kick_world(step_s));
    const KickOutcome late = play(world, arriving_ball(2.03), stop);
    EXPECT_FALSE(late.contact);
    EXPECT_NEAR(late.reward, -4.0, 1e-12);
    const KickOutcome last = play(world, arriving_ball(1.97), stop);
    EXPECT_TRUE(last.contact);
    EXPECT_EQ(last.contact_decision, kick_decisions - 1);
    EXPECT_NEAR(last.reward, -3.9 + 3.0, 1e-3);
    EXPECT_TRUE(last.ball_measured);
  }
}

TEST(KickEpisode, EveryDecisionIsPaidOnce) {
  World world(kick_world(0.010));
  KickEpisode episode;
  episode.begin(world, resting_ball(0.6, 0.0));
  drive_straight(world, 2.55);
  double sum = 0.0;
  bool paid = false;
  for (int decision = 0; decision < kick_decisions; ++decision) {
    for (int i = 0; i < 5; ++i) {
      episode.step(world);
    }
    const bool contact = episode.outcome().contact;
    const double reward = episode.end_decision();
    if (!contact) {
      EXPECT_EQ(reward, -0.1);
    } else if (!paid) {
      EXPECT_EQ(episode.outcome().contact_decision, decision);
      EXPECT_GT(reward, 5.0);
      paid = true;
    } else {
      EXPECT_EQ(reward, 0.0);
    }
    sum += reward;
    EXPECT_EQ(episode.outcome().reward, sum);
  }
  EXPECT_TRUE(paid);
  EXPECT_EQ(episode.end_decision(), 0.0);
  EXPECT_EQ(episode.outcome().reward, sum);
}

TEST(KickEpisode, TheBallIsMeasuredAHundredMillisecondsAfterTheContactStep) {
  for (const double step_s : {0.001, 0.010}) {
    World world(kick_world(step_s));
    KickEpisode episode;
    episode.begin(world, resting_ball(0.6, 0.0));
    drive_straight(world, 2.55);
    while (!episode.outcome().contact) {
      episode.step(world);
    }
    int steps = 0;
    while (!episode.outcome().ball_measured) {
      episode.step(world);
      ++steps;
    }
    EXPECT_EQ(steps, step_s == 0.001 ? 100 : 10);
    EXPECT_EQ(episode.outcome().ball_speed_m_s,
              std::hypot(world.ball().velocity_m_s.x, world.ball().velocity_m_s.y));
  }
}

TEST(KickEpisode, BeginForgetsTheEpisodeBefore) {
  World world(kick_world(0.010));
  KickEpisode episode;
  episode.begin(world, resting_ball(0.3, 0.0));
  drive_straight(world, 2.55);
  for (int i = 0; i < 20; ++i) {
    episode.step(world);
  }
  episode.end_decision();
  ASSERT_TRUE(episode.outcome().contact);
  episode.begin(world, resting_ball(0.0, 2.0));
  EXPECT_FALSE(episode.outcome().contact);
  EXPECT_EQ(episode.outcome().reward, 0.0);
  EXPECT_EQ(episode.end_decision(), -0.1);
}

TEST(KickEpisode, AKickNeedsTheFrontFaceTheDirectionAndTheSpeed) {
  World world(kick_world(0.010));
  int kicks = 0;
  int not_in_front = 0;
  int astray = 0;
  int slow = 0;
  for (std::uint64_t i = 0; i < 1'500; ++i) {
    const KickOutcome outcome = play(world, draw_kick(5, i, PoseMode::origin), random_actions(i));
    const bool ahead = std::abs(outcome.ball_angle_rad) <= 15.0 * pi / 180.0;
    const bool fast = outcome.ball_speed_m_s > 1.0;
    EXPECT_EQ(outcome.kicked, outcome.ball_measured && outcome.front_face && ahead && fast) << i;
    kicks += outcome.kicked ? 1 : 0;
    not_in_front += outcome.ball_measured && !outcome.front_face && ahead && fast ? 1 : 0;
    astray += outcome.front_face && !ahead && fast ? 1 : 0;
    slow += outcome.front_face && ahead && !fast ? 1 : 0;
  }
  EXPECT_GT(kicks, 0);
  EXPECT_GT(not_in_front, 0);
  EXPECT_GT(astray, 0);
  EXPECT_GT(slow, 0);
}

// The physics knows no place and no direction; only rounding does.
TEST(KickEpisode, TheSameEpisodeAnywhereEndsTheSame) {
  World world(kick_world(0.010));
  int contacts = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Actions actions = random_actions(i);
    const KickOutcome origin = play(world, draw_kick(11, i, PoseMode::origin), actions);
    const KickOutcome anywhere = play(world, draw_kick(11, i, PoseMode::anywhere), actions);
    ASSERT_EQ(origin.contact, anywhere.contact) << i;
    EXPECT_NEAR(origin.reward, anywhere.reward, 1e-6) << i;
    EXPECT_EQ(origin.front_face, anywhere.front_face) << i;
    EXPECT_NEAR(origin.ball_speed_m_s, anywhere.ball_speed_m_s, 1e-6) << i;
    EXPECT_NEAR(std::remainder(origin.ball_angle_rad - anywhere.ball_angle_rad, 2.0 * pi), 0.0, 1e-6) << i;
    contacts += origin.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 50);
}

}  // namespace
}  // namespace striker::sil

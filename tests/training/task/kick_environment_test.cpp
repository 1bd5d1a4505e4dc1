// SPDX-License-Identifier: Apache-2.0
// The episodes that a learner and an evaluation meet.
#include "training/task/kick_environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/training/fixtures.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {
namespace {

int scripted(const KickEnvironment& seen) {
  const RcsState& state = seen.state();
  return state.ball_x_m < 0.4 ? 2 : static_cast<int>(std::abs(state.ball_y_m) > 0.2);
}

constexpr std::uint64_t seed = 5;

void expect_the_same_alone_and_after_others(const TaskConfig& config) {
  KickEnvironment busy(config);
  for (std::uint64_t i = 0; i < 200; ++i) {
    play(busy, seed, i, scripted);
  }
  KickEnvironment fresh(config);
  const auto late = play(busy, seed, 200, scripted);
  const auto alone = play(fresh, seed, 200, scripted);
  EXPECT_EQ(late.reward, alone.reward);
  EXPECT_EQ(late.ball_speed_m_s, alone.ball_speed_m_s);
  EXPECT_EQ(late.theta_contact_rad, alone.theta_contact_rad);
}

TEST(KickEnvironment, AnEpisodeIsTheSameAloneAndAfterOthers) {
  for (const Physics physics : {Physics::planar, Physics::full}) {
    expect_the_same_alone_and_after_others({.physics = physics});
    expect_the_same_alone_and_after_others({.physics = physics, .velocities = Velocities::estimated});
  }
}

TEST(KickEnvironment, RewardsOfTheStepsAddUpToTheOutcome) {
  KickEnvironment env({});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    env.reset(seed, i);
    double sum = 0.0;
    int steps = 0;
    int told = 0;
    for (bool last = false; !last; ++steps) {
      const StepResult result = env.step(0);
      sum += result.reward;
      told += result.success ? 1 : 0;
      last = result.last;
    }
    EXPECT_EQ(steps, sil::kick_decisions);
    EXPECT_NEAR(sum, env.outcome().reward, 1e-12);
    EXPECT_EQ(told, env.outcome().contact ? 1 : 0);
    contacts += told;
  }
  EXPECT_GT(contacts, 5);
  EXPECT_LT(contacts, 95);
}

// The step of the contact lasts until the ball is measured, and pays for how it leaves.
TEST(KickEnvironment, AnAimedContactIsPaidForTheBallThatLeaves) {
  for (const Physics physics : {Physics::planar, Physics::full}) {
    KickEnvironment env({.physics = physics, .rules = {.reward = sil::KickReward::aimed}});
    int contacts = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
      env.reset(seed, i);
      StepResult result;
      int steps = 0;
      for (; !result.end; ++steps) {
        EXPECT_EQ(result.reward, steps == 0 ? 0.0 : -0.1);
        result = env.step(scripted(env));
      }
      const sil::KickOutcome& outcome = env.outcome();
      ASSERT_EQ(outcome.ball_measured, outcome.contact) << i;
      if (outcome.contact) {
        const double along_m_s = outcome.ball_speed_m_s * std::cos(outcome.ball_angle_rad);
        const double across_m_s = outcome.ball_speed_m_s * std::sin(outcome.ball_angle_rad);
        const double paid = std::max(-4.0, 2.0 * (along_m_s - std::abs(across_m_s)));
        EXPECT_NEAR(result.reward, paid, 1e-12) << i;
        EXPECT_NEAR(outcome.reward, paid - 0.1 * (steps - 1), 1e-12) << i;
        ++contacts;
      }
    }
    EXPECT_GT(contacts, 10);
  }
}

TEST(KickEnvironment, PlayMeasuresEveryContact) {
  KickEnvironment env({});
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto outcome = play(env, seed, i, scripted);
    EXPECT_EQ(outcome.contact, outcome.ball_measured) << i;
  }
}

// What the fast world teaches holds in the full one (bounds: tests/world/planar_world_test.cpp).
TEST(KickEnvironment, BothWorldsTellTheSameEpisode) {
  KickEnvironment fast({.physics = Physics::planar});
  KickEnvironment full({.physics = Physics::full});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto a = play(fast, seed, i, scripted);
    const auto b = play(full, seed, i, scripted);
    EXPECT_EQ(a.contact_decision, b.contact_decision) << i;
    EXPECT_NEAR(a.reward, b.reward, 3e-3) << i;
    EXPECT_LT((fast.features() - full.features()).norm(), a.contact ? 0.3F : 1e-3F) << i;
    EXPECT_EQ(fast.simulated_s(), full.simulated_s());
    contacts += a.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 10);
}

// Before the contact nothing but damping acts on the ball: positions 50 ms apart tell its mean velocity, at
// most half a frame old.
TEST(KickEnvironment, EstimatedBallVelocityIsTheTrueOneWithinItsLag) {
  KickEnvironment exact({});
  KickEnvironment estimated({.velocities = Velocities::estimated});
  for (std::uint64_t i = 0; i < 50; ++i) {
    exact.reset(seed, i);
    estimated.reset(seed, i);
    for (int t = 0; t < 10 && !exact.outcome().contact; ++t) {
      const RcsState& a = exact.state();
      const RcsState& b = estimated.state();
      const double speed = std::hypot(a.ball_vx_m_s, a.ball_vy_m_s);
      EXPECT_LT(std::hypot(a.ball_vx_m_s - b.ball_vx_m_s, a.ball_vy_m_s - b.ball_vy_m_s), 0.02 * speed);
      EXPECT_EQ(a.ball_x_m, b.ball_x_m);
      exact.step(2);
      estimated.step(2);
    }
  }
}

// Training, validation and calibration draw their balls from numbers that an evaluation cannot reach.
TEST(KickEnvironment, NoEvaluationMeetsATrainingEpisode) {
  EXPECT_GT(first_calibration_episode, std::uint64_t{1} << 60U);
  const std::set<std::uint64_t> firsts{0, first_calibration_episode, first_validation_episode,
                                       first_training_episode};
  EXPECT_EQ(firsts.size(), 4U);
  std::set<double> balls;
  for (const std::uint64_t first : firsts) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      balls.insert(sil::draw_kick(seed, first + i, sil::PoseMode::origin).ball.position_m.x);
    }
  }
  EXPECT_EQ(balls.size(), 4000U);
}

TEST(KickEnvironment, TheStateAtTheStartIsThePosesIndependent) {
  KickEnvironment origin({});
  KickEnvironment anywhere({.pose = sil::PoseMode::anywhere});
  for (std::uint64_t i = 0; i < 20; ++i) {
    origin.reset(seed, i);
    anywhere.reset(seed, i);
    EXPECT_LT((origin.features() - anywhere.features()).norm(), 1e-5F);
  }
}

// The same situation on the other side of the heading: the same features, and the wheels swapped.
TEST(KickEnvironment, AMirroredTaskKnowsTheLeftOnly) {
  TaskConfig task;
  task.one_sided = true;
  task.actions = {{.left_m_s = 2.0, .right_m_s = 0.0}, {.left_m_s = -1.0, .right_m_s = -1.5}};
  KickEnvironment mirrored(task);
  task.one_sided = false;
  KickEnvironment plain(task);
  std::swap(task.actions[0].left_m_s, task.actions[0].right_m_s);
  KickEnvironment swapped(task);
  int right_side = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    for (KickEnvironment* env : {&mirrored, &plain, &swapped}) {
      env->reset(seed, i);
    }
    const bool right = plain.state().ball_y_m < 0.0;
    const Features image = plain.features().cwiseProduct(mirror_factors(task.inputs));
    EXPECT_LT((mirrored.features() - (right ? image : plain.features())).norm(), 1e-6F);
    EXPECT_GE(mirrored.features()[1], 0.0F);
    EXPECT_GE(mirrored.raw()[1], 0);
    for (KickEnvironment* env : {&mirrored, &plain, &swapped}) {
      env->step(0);
    }
    const KickEnvironment& same = right ? swapped : plain;
    EXPECT_EQ(mirrored.state().ball_x_m, same.state().ball_x_m);
    EXPECT_EQ(mirrored.state().ball_y_m, same.state().ball_y_m);
    right_side += right ? 1 : 0;
  }
  EXPECT_GT(right_side, 20);
  EXPECT_LT(right_side, 80);
}

// A user's own actions, inputs and reward.
TEST(KickEnvironment, ATaskOfOnesOwn) {
  TaskConfig task;
  task.actions = {{.left_m_s = 1.0, .right_m_s = -1.0}, {.left_m_s = 0.0, .right_m_s = 0.0}};
  task.inputs = {{.element = Element::field_robot_heading}, {.element = Element::decisions_left}};
  task.rules.waiting_reward = -1.0;
  KickEnvironment env(task);
  env.reset(seed, 1);
  EXPECT_EQ(env.features()[1], 1.0F);
  EXPECT_EQ(env.step(0).reward, -1.0);
  EXPECT_EQ(env.features()[1], 39.0F / 40.0F);
  EXPECT_LT(env.features()[0], 0.0F);  // it turned to the right
}

// A reading of the paper: the contact is paid in every decision, and the episode goes on.
TEST(KickEnvironment, EveryContactMayPay) {
  TaskConfig every;
  every.rules.every_contact = true;
  every.goes_on = true;
  KickEnvironment official({});
  KickEnvironment reading(every);
  int more = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const auto rewards = [i](KickEnvironment& env) {
      sil::Random random(seed, i, 1);
      env.reset(seed, i);
      std::vector<double> paid;
      for (bool last = false; !last;) {
        const StepResult result = env.step(static_cast<int>(random.below(3)));
        paid.push_back(result.reward);
        last = result.last;
        const bool done = result.success && !env.config().goes_on;
        EXPECT_EQ(result.end, result.last || done);
        EXPECT_EQ(result.truncated, result.last && !done);
      }
      return paid;
    };
    const auto a = rewards(official);
    const auto b = rewards(reading);
    const auto contact = static_cast<std::size_t>(std::max(0, official.outcome().contact_decision));
    for (std::size_t t = 0; t < a.size(); ++t) {
      const bool after = official.outcome().contact && t > contact;
      EXPECT_TRUE(after ? a[t] == 0.0 : a[t] == b[t]);
      more += after && b[t] != 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(more, 5);
}

TEST(KickEnvironment, UnsignedSpeedPaysBackwardHits) {
  TaskConfig reading;
  reading.rules.signed_speed = false;
  KickEnvironment official({});
  KickEnvironment unsigned_speed(reading);
  int backward = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto reverse = [](const KickEnvironment& /*seen*/) { return 2; };
    const auto a = play(official, seed, i, reverse);
    const auto b = play(unsigned_speed, seed, i, reverse);
    if (a.contact && a.v_contact_m_s < 0.0) {
      EXPECT_NEAR(b.reward - a.reward, -2.0 * 3.92 * a.v_contact_m_s, 1e-9);
      ++backward;
    }
  }
  EXPECT_GT(backward, 10);
}

// The full throttle of one decision, from rest: two wheels' forces, each no more than torque and grip allow, push the mass
// and half of each wheel once more, which spins.
TEST(KickEnvironment, ARobotAcceleratesAsItsDescriptionSays) {
  core::RobotDescription heavy = core::forward;
  heavy.body_mass_g = 3700;
  core::RobotDescription slippery = core::defender;
  slippery.tyre_friction_percent = 40;
  for (const core::RobotDescription& robot : {core::forward, core::goalkeeper, heavy, slippery}) {
    const double weight_N = 9.81 * (robot.body_mass_g + 2 * robot.wheel_mass_g) / 1e3;
    const double torque_N = 1e3 * robot.torque_limit_mNm / robot.wheel_radius_um;
    const double force_N = 2.0 * std::min(torque_N, robot.tyre_friction_percent / 1e2 * weight_N / 2.0);
    const double gain_m_s = physics_step_s * force_N / ((robot.body_mass_g + 3 * robot.wheel_mass_g) / 1e3);
    double expected_m_s = 0.0;
    for (int i = 0; i < steps_per_decision; ++i) {
      expected_m_s = sil::kept_in_10_ms * (expected_m_s + gain_m_s);
    }
    ASSERT_LT(expected_m_s, robot.top_rim_speed_mm_s / 1e3);
    KickEnvironment fast({.robot = robot});
    fast.reset(1, 0);
    (void)fast.step(0);
    EXPECT_NEAR(fast.state().robot_speed_m_s, expected_m_s, 1e-9) << robot.body_mass_g;
    KickEnvironment full({.robot = robot, .physics = Physics::full});
    full.reset(1, 0);
    (void)full.step(0);
    if (robot != slippery) {  // the skids carry some of the weight while it accelerates
      EXPECT_NEAR(full.state().robot_speed_m_s, expected_m_s, 0.002) << robot.body_mass_g;
    }
    EXPECT_LT(full.state().robot_speed_m_s, expected_m_s + 0.002) << robot.body_mass_g;
  }
}

}  // namespace
}  // namespace striker::training

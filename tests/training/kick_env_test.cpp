// The episodes that a learner and an evaluation meet.
#include "kick_env.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "fixtures.hpp"

namespace striker::training {
namespace {

int scripted(const RcsState& state) {
  return state.ball_x_m < 0.4 ? 2 : static_cast<int>(std::abs(state.ball_y_m) > 0.2);
}

sil::KickStart start_of(std::uint64_t episode) {
  return sil::draw_kick(5, episode, sil::PoseMode::origin);
}

void expect_the_same_alone_and_after_others(const EnvConfig& config) {
  KickEnv busy(config);
  for (std::uint64_t i = 0; i < 200; ++i) {
    play(busy, start_of(i), scripted);
  }
  KickEnv fresh(config);
  const auto late = play(busy, start_of(200), scripted);
  const auto alone = play(fresh, start_of(200), scripted);
  EXPECT_EQ(late.reward, alone.reward);
  EXPECT_EQ(late.ball_speed_m_s, alone.ball_speed_m_s);
  EXPECT_EQ(late.theta_contact_rad, alone.theta_contact_rad);
}

TEST(KickEnv, AnEpisodeIsTheSameAloneAndAfterOthers) {
  for (const World world : {World::fast, World::full}) {
    expect_the_same_alone_and_after_others({.velocities = Velocities::exact, .world = world});
    expect_the_same_alone_and_after_others({.velocities = Velocities::estimated, .world = world});
  }
}

TEST(KickEnv, RewardsOfTheStepsAddUpToTheOutcome) {
  KickEnv env({});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    env.reset(start_of(i));
    double sum = 0.0;
    int steps = 0;
    int told = 0;
    for (bool last = false; !last; ++steps) {
      const StepResult result = env.step(0);
      sum += result.reward;
      told += result.contact ? 1 : 0;
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

TEST(KickEnv, PlayMeasuresEveryContact) {
  KickEnv env({});
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto outcome = play(env, start_of(i), scripted);
    EXPECT_EQ(outcome.contact, outcome.ball_measured) << i;
  }
}

// What the fast world teaches holds in the full one (bounds: tests/sim/planar_world_test.cpp).
TEST(KickEnv, BothWorldsTellTheSameEpisode) {
  KickEnv fast({.world = World::fast});
  KickEnv full({.world = World::full});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto a = play(fast, start_of(i), scripted);
    const Features seen = features(fast.state());
    const auto b = play(full, start_of(i), scripted);
    EXPECT_EQ(a.contact_decision, b.contact_decision) << i;
    EXPECT_NEAR(a.reward, b.reward, 3e-3) << i;
    EXPECT_LT((seen - features(full.state())).norm(), a.contact ? 0.3F : 1e-3F) << i;
    EXPECT_EQ(fast.simulated_s(), full.simulated_s());
    contacts += a.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 10);
}

// Before the contact nothing but damping acts on the ball: positions 50 ms apart tell its mean velocity, at
// most half a frame old.
TEST(KickEnv, EstimatedBallVelocityIsTheTrueOneWithinItsLag) {
  KickEnv exact({});
  KickEnv estimated({.velocities = Velocities::estimated});
  for (std::uint64_t i = 0; i < 50; ++i) {
    exact.reset(start_of(i));
    estimated.reset(start_of(i));
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
TEST(KickEnv, NoEvaluationMeetsATrainingEpisode) {
  EXPECT_GT(calibration_episodes, std::uint64_t{1} << 60U);
  const std::set<std::uint64_t> firsts{0, calibration_episodes, validation_episodes, training_episodes};
  EXPECT_EQ(firsts.size(), 4U);
  std::set<double> balls;
  for (const std::uint64_t first : firsts) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      balls.insert(start_of(first + i).ball.position_m.x);
    }
  }
  EXPECT_EQ(balls.size(), 4000U);
}

TEST(KickEnv, TheStateAtTheStartIsThePosesIndependent) {
  KickEnv env({});
  for (std::uint64_t i = 0; i < 20; ++i) {
    env.reset(sil::draw_kick(5, i, sil::PoseMode::origin));
    const Features here = features(env.state());
    env.reset(sil::draw_kick(5, i, sil::PoseMode::anywhere));
    EXPECT_LT((features(env.state()) - here).norm(), 1e-5F);
  }
}

}  // namespace
}  // namespace striker::training

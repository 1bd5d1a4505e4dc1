// SPDX-License-Identifier: Apache-2.0
// The scripted rivals, and where the interceptor's parameters come from.
#include "training/ceiling/rivals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sil/world/random.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {
namespace {

double mean_reward(KickEnvironment& env, std::uint64_t seed, std::uint64_t first, int episodes,
                   const std::function<ActionRule(std::uint64_t)>& choice_of) {
  double sum = 0.0;
  for (int i = 0; i < episodes; ++i) {
    const std::uint64_t episode = first + static_cast<std::uint64_t>(i);
    sum += play(env, seed, episode, choice_of(episode)).reward;
  }
  return sum / episodes;
}

TEST(Rivals, AreWorthWhatTheirSkillSays) {
  KickEnvironment env({.physics = Physics::planar});
  const auto mean_of = [&env](Rival rival) {
    return mean_reward(env, 31, 0, 1'000,
                       [rival](std::uint64_t episode) { return rule_of(rival, 31, episode); });
  };
  for (const Rival rival : {Rival::forward, Rival::stop, Rival::random}) {
    EXPECT_NEAR(mean_of(rival), -3.4, 0.3) << name_of(rival);
  }
  const double interceptor = mean_of(Rival::interceptor);
  const double planner = mean_of(Rival::planner);
  EXPECT_GT(interceptor, 6.0);
  EXPECT_GT(planner, interceptor + 0.7);
}

TEST(Rivals, ThePlannerGetsWhatItPlans) {
  KickEnvironment env({.physics = Physics::planar});
  int contacts = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const BallTrack track = ball_track(sil::draw_kick(32, i, sil::PoseMode::origin));
    const PlanValue planned = best_plan(line_drive(core::forward), track, {}, sil::kick_decisions);
    const sil::KickOutcome outcome = play(env, 32, i, plan_ahead);
    // Planning anew can only find something better on the way.
    EXPECT_GE(outcome.reward, planned.reward - 1e-6) << i;
    contacts += outcome.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 150);
}

TEST(Rivals, TheInterceptorsParametersAreTheBestOfTheSearch) {
  constexpr std::uint64_t seed = 1;
  constexpr std::uint64_t stream = 106;  // of this search alone
  KickEnvironment env({.physics = Physics::planar});
  InterceptorParameters best;
  double best_mean = no_contact_reward;
  for (std::uint64_t i = 0; i < 1'000; ++i) {
    sil::Random random(seed, i, stream);
    InterceptorParameters drawn;
    drawn.stop_short_m = random.uniform(0.0, 0.3);
    drawn.lead_s = random.uniform(-0.1, 0.2);
    drawn.run_up_m = random.uniform(0.0, 1.0);
    drawn.time_to_back_up_s = random.uniform(0.0, 0.6);
    const double mean = mean_reward(env, seed, first_training_episode, 2'000, [&drawn](std::uint64_t) {
      return [&drawn](const KickEnvironment& seen) { return intercept(drawn, seen); };
    });
    if (mean > best_mean) {
      best_mean = mean;
      best = drawn;
    }
  }
  const InterceptorParameters standing;
  EXPECT_NEAR(standing.stop_short_m, best.stop_short_m, 1e-4);
  EXPECT_NEAR(standing.lead_s, best.lead_s, 1e-4);
  EXPECT_NEAR(standing.run_up_m, best.run_up_m, 1e-4);
  EXPECT_NEAR(standing.time_to_back_up_s, best.time_to_back_up_s, 1e-4);
}

}  // namespace
}  // namespace striker::training

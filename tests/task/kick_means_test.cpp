// SPDX-License-Identifier: Apache-2.0
// What play without skill is worth over 2,000 episodes. About -3.4 is also what a planar model without ODE
// gives for all three.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sil/task/kick_report.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

constexpr std::uint64_t episodes = 2'000;

KickSummary mean_of(const char* name, const std::function<Actions(std::uint64_t)>& actions) {
  World world(kick_world(0.010));
  std::vector<KickOutcome> outcomes;
  for (std::uint64_t i = 0; i < episodes; ++i) {
    outcomes.push_back(play(world, draw_kick(1, i, PoseMode::origin), actions(i)));
  }
  const KickSummary summary = kick_summary(outcomes);
  testing::Test::RecordProperty("policy", name);
  testing::Test::RecordProperty("mean_reward", std::to_string(summary.mean_reward));
  testing::Test::RecordProperty("contact_rate", std::to_string(summary.contact_rate));
  std::printf("%s: mean reward %.3f +- %.3f, contact rate %.3f, kick rate %.3f\n", name, summary.mean_reward,
              summary.reward_ci95, summary.contact_rate, summary.kick_rate);
  return summary;
}

TEST(KickMeans, Random) {
  const KickSummary summary = mean_of("random", random_actions);
  EXPECT_NEAR(summary.mean_reward, -3.4, 0.2);
  EXPECT_LT(summary.kick_rate, 0.1);
}

TEST(KickMeans, Forward) {
  const KickSummary summary = mean_of("forward", [](std::uint64_t) { return Actions(kick_decisions, 1); });
  EXPECT_NEAR(summary.mean_reward, -3.4, 0.2);
}

TEST(KickMeans, Stop) {
  const KickSummary summary = mean_of("stop", [](std::uint64_t) { return Actions(kick_decisions, 0); });
  EXPECT_NEAR(summary.mean_reward, -3.4, 0.2);
  // The circle of the robot and the ball against the disc aimed at, less the slow balls.
  EXPECT_NEAR(summary.contact_rate, 0.33, 0.05);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What the guide leads to is good, it lets go anywhere before, and only nominal episodes are led.
#include "training/rollout/guide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/training/fixtures.hpp"
#include "training/rollout/rollouts.hpp"

namespace striker::training {
namespace {

constexpr std::uint64_t seed = 7;

class GuideTo : public testing::TestWithParam<sil::KickReward> {};

// A planner with the whole simulator gets 4.4 of the aimed kick and 8.1 of the other; own play begins at -3.5.
TEST_P(GuideTo, AContactThatPaysFromAnywhereBeforeIt) {
  const TaskConfig task{.rules = {.reward = GetParam()}};
  Guide guide(task);
  KickEnvironment env(task);
  sil::Random random(seed, 0, 1);
  double sum = 0.0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    const Guidance guidance = guide.lead(seed, number, random);
    const sil::KickOutcome outcome = play(env, seed, number, [&](const KickEnvironment& seen) -> int {
      return guidance.actions.at(static_cast<std::size_t>(sil::kick_decisions - seen.decisions_left()));
    });
    sum += outcome.reward;
    EXPECT_LE(guidance.decisions, std::max(outcome.contact_decision, 0)) << number;
    if (number > 0) {
      continue;
    }
    ASSERT_TRUE(outcome.contact);
    std::set<int> ends;
    for (int i = 0; i < 200; ++i) {
      ends.insert(guide.lead(seed, number, random).decisions);
    }
    EXPECT_EQ(static_cast<int>(ends.size()), outcome.contact_decision + 1) << number;
  }
  EXPECT_GT(sum / 60.0, GetParam() == sil::KickReward::aimed ? 4.0 : 7.0);
}

INSTANTIATE_TEST_SUITE_P(Guide, GuideTo, testing::Values(sil::KickReward::contact, sil::KickReward::aimed));

double mean_reward(double guided_share, double randomised_share) {
  TaskConfig task;
  task.randomise.share = randomised_share;
  task.randomise.mass = {.low = -0.3, .high = 0.3};
  const Parameters network = some_parameters(3);
  Rollouts rollouts(network.shape(),
                    {.round_episodes = 300, .longest_hold = 1, .guided_share = guided_share, .focus = 1.0},
                    {task});
  LabelStore labels(6, 3, 100'000);
  sil::Random exploring(seed, 0, 1);
  double sum = 0.0;
  for (const EpisodeRow& row : rollouts.round(network, {.seed = seed, .episodes = 300}, exploring, labels)) {
    sum += row.reward;
  }
  return sum / 300.0;
}

// A network that knows nothing loses most of what it was led to.
TEST(Guide, LeadsNominalEpisodesOnlyAndToMore) {
  EXPECT_GT(mean_reward(1.0, 0.0), mean_reward(0.0, 0.0) + 0.1);
  EXPECT_EQ(mean_reward(1.0, 1.0), mean_reward(0.0, 1.0));
}

TEST(Guide, KnowsTheOfficialTaskOnly) {
  EXPECT_EQ(Guide::unfit({}), "");
  EXPECT_EQ(Guide::unfit({.rules = {.reward = sil::KickReward::aimed}}), "");
  EXPECT_TRUE(Guide::unfit({.actions = {{1.0, 1.0}}}).starts_with("task.actions: "));
  EXPECT_TRUE(Guide::unfit({.rules = {.waiting_reward = -0.2}}).starts_with("reward.waiting: "));
  EXPECT_TRUE(Guide::unfit({.rules = {.angle_reward = 2.0}}).starts_with("reward.angle: "));
  EXPECT_TRUE(Guide::unfit({.rules = {.speed_reward_s_m = 2.0}}).starts_with("reward.speed: "));
  EXPECT_TRUE(Guide::unfit({.rules = {.signed_speed = false}}).starts_with("reward.contact_speed: "));
}

}  // namespace
}  // namespace striker::training

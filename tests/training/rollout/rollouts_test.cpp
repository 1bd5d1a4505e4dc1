// SPDX-License-Identifier: Apache-2.0
// Labels against the environment: each is what it pays for the action and the network's greedy play after it.
#include "training/rollout/rollouts.hpp"

#include <gtest/gtest.h>

#include "sil/world/random_streams.hpp"
#include "tests/training/fixtures.hpp"
#include "training/line/planner.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {
namespace {

constexpr std::uint64_t seed = 7;
constexpr RolloutConfig config{.round_episodes = 32, .longest_hold = 5, .focus = 1.0};

// What the round plays with epsilon: the stream that it draws from, read beside it.
class Explorer {
 public:
  Explorer(double epsilon, int actions) : epsilon_(epsilon), actions_(static_cast<std::uint64_t>(actions)) {}
  int operator()(int greedy, sil::Random& random) {
    if (held_ == 0 && random.uniform() < epsilon_) {
      held_ = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(config.longest_hold)));
      action_ = static_cast<int>(random.below(actions_));
    }
    return held_ > 0 ? (--held_, action_) : greedy;
  }

 private:
  double epsilon_;
  std::uint64_t actions_;
  int held_ = 0;
  int action_ = 0;
};

// The reward of an episode that begins with these actions and goes on greedily.
double reward_of(KickEnvironment& env, GreedyRule& greedy, int episode, const std::vector<int>& begin) {
  std::size_t next = 0;
  return play(env, seed, first_training_episode + static_cast<std::uint64_t>(episode),
              [&](const auto& seen) { return next < begin.size() ? begin[next++] : greedy(seen); })
      .reward;
}

// Where the guide leads the episode: drawn as the round does.
Guidance guidance_of(Guide& guide, double share, int episode) {
  const std::uint64_t number = first_training_episode + static_cast<std::uint64_t>(episode);
  sil::Random random(seed, number, sil::random_stream::guide);
  return random.uniform() < share ? guide.lead(seed, number, random) : Guidance{};
}

struct Played {
  double epsilon = 0.0;
  double guided_share = 0.0;
};

class Labels : public testing::TestWithParam<Played> {};

TEST_P(Labels, AreWhatTheEnvironmentPays) {
  const auto [epsilon, guided_share] = GetParam();
  const TaskConfig task{.one_sided = true};
  RolloutConfig guided = config;
  guided.guided_share = guided_share;
  Guide guide(task);
  const Parameters network = some_parameters(3);
  KickEnvironment env(task);
  GreedyRule greedy(network);
  Rollouts rollouts(network.shape(), guided, {task});
  int labelled = 0;
  int led = 0;
  for (int episode = 0; episode < 150; ++episode) {
    sil::Random exploring(seed, static_cast<std::uint64_t>(episode), 1);
    sil::Random beside = exploring;
    LabelStore labels(6, 3, 100);
    const auto rows =
        rollouts.round(network, {.seed = seed, .first_episode = episode, .episodes = 1, .epsilon = epsilon},
                       exploring, labels);
    const Guidance guidance = guidance_of(guide, guided_share, episode);
    led += guidance.decisions > 0 ? 1 : 0;
    Explorer explorer(epsilon, 3);
    std::vector<int> played;
    std::vector<std::pair<Features, Eigen::Vector3d>> expected;
    env.reset(seed, first_training_episode + static_cast<std::uint64_t>(episode));
    for (bool end = false; !end;) {
      const Features features = env.features();
      Eigen::Vector3d values;
      std::vector<int> branch = played;
      for (branch.push_back(0); branch.back() < 3; ++branch.back()) {
        KickEnvironment other(task);
        values[branch.back()] = reward_of(other, greedy, episode, branch);
      }
      expected.emplace_back(features, values);
      const std::size_t decision = played.size();
      played.push_back(static_cast<int>(decision) < guidance.decisions ? guidance.actions.at(decision)
                                                                       : explorer(greedy(env), beside));
      end = env.step(played.back()).end;
    }
    EXPECT_NEAR(rows.front().reward, reward_of(env, greedy, episode, played), 1e-9);
    Eigen::Index place = 0;
    for (const auto& [features, values] : expected) {
      if (values.maxCoeff() - values.minCoeff() > 1e-6) {
        ASSERT_LT(place, labels.size()) << episode;
        EXPECT_LT((labels.features(place) - features).cwiseAbs().maxCoeff(), 1e-6F);
        EXPECT_LT((labels.values(place).cast<double>() - values).cwiseAbs().maxCoeff(), 1e-5) << episode;
        EXPECT_EQ(labels.weight(place), 1.0F);
        ++place;
      }
    }
    EXPECT_EQ(place, labels.size()) << episode;
    labelled += static_cast<int>(place);
  }
  EXPECT_GT(labelled, 200);
  EXPECT_EQ(led > 20, guided_share > 0.0) << led;
}

INSTANTIATE_TEST_SUITE_P(Rollout, Labels,
                         testing::Values(Played{}, Played{.epsilon = 0.2},
                                         Played{.epsilon = 0.2, .guided_share = 0.5}));

// In doubt all states are labelled, elsewhere fewer; weighted, they stand for all.
TEST(Labels, TheirWeightsMakeUpForTheFocus) {
  const TaskConfig task;
  const Parameters network = some_parameters(3);
  const auto weights_of = [&](double focus) {
    RolloutConfig focused = config;
    focused.round_episodes = 2000;
    focused.focus = focus;
    Rollouts rollouts(network.shape(), focused, {task});
    LabelStore labels(6, 3, 100'000);
    sil::Random exploring(seed, 0, sil::random_stream::exploration);
    (void)rollouts.round(network, {.seed = seed, .episodes = 2000, .epsilon = 0.05}, exploring, labels);
    return Eigen::VectorXf(labels.content().bottomRows(1).transpose());
  };
  const Eigen::VectorXf all = weights_of(1.0);
  const Eigen::VectorXf some = weights_of(4.0);
  EXPECT_EQ(all.minCoeff(), 1.0F);
  EXPECT_EQ(all.maxCoeff(), 1.0F);
  EXPECT_EQ(some.minCoeff(), 1.0F);
  EXPECT_FLOAT_EQ(some.maxCoeff(), 4.0F);
  EXPECT_LT(some.size(), all.size() * 3 / 4);
  EXPECT_NEAR(static_cast<double>(some.sum() / all.sum()), 1.0, 0.05);
}

// The planner's labels are what its plans get, never less than what any of three actions held gets.
TEST(Labels, ThePlannersAreAtLeastThoseOfHeldActions) {
  const LineKick kick{TaskConfig{}};
  int better = 0;
  for (std::uint64_t number = 0; number < 100; ++number) {
    const LineEpisode episode = kick.draw(seed, number);
    const double planned = plan_reward(kick, episode, {});
    LineRobot held;
    while (!held.over) {
      kick.step(episode, held, 0);
    }
    EXPECT_GE(planned, held.reward);
    better += planned > held.reward ? 1 : 0;
  }
  EXPECT_GT(better, 50);
}

}  // namespace
}  // namespace striker::training

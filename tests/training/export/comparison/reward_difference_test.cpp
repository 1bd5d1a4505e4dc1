// SPDX-License-Identifier: Apache-2.0
// The reward that an integer network loses against the float one, in paired episodes.
#include "training/export/comparison/reward_difference.hpp"

#include <algorithm>
#include <cmath>

#include "tests/training/fixtures.hpp"
#include "training/export/quantise.hpp"
#include "training/task/environments.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {
namespace {

constexpr int episodes = 60;

// A network that always takes this action.
Parameters stubborn(int action) {
  Parameters parameters({});
  parameters.values.setZero();
  parameters.biases(2)(action) = 1.0F;
  return parameters;
}

IntegerNetwork integer(const Parameters& parameters) {
  std::mt19937 random(1);
  std::vector<RawState> states(50);
  std::generate(states.begin(), states.end(), [&random] { return some_state(random); });
  return quantise(parameters, rcs_inputs(), states, WeightType::int16).network;
}

std::vector<double> rewards_of(int action) {
  KickEnvironment env({.physics = Physics::full});
  std::vector<double> rewards;
  for (std::uint64_t i = 0; i < episodes; ++i) {
    rewards.push_back(play(env, reward_difference_seed, first_reward_difference_episode + i,
                           [action](const KickEnvironment&) { return action; })
                          .reward);
  }
  return rewards;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

TEST(RewardDifference, IsNothingBetweenNetworksThatChooseAlike) {
  const RewardDifference found = reward_difference(stubborn(1), integer(stubborn(1)), {}, episodes);
  EXPECT_EQ(found.episodes, episodes);
  EXPECT_EQ(found.float_mean, found.integer_mean);
  EXPECT_EQ(found.standard_error, 0.0);
}

TEST(RewardDifference, IsThatOfTheTwoRulesOnTheSameEpisodes) {
  const std::vector<double> stops = rewards_of(1);
  const std::vector<double> backs = rewards_of(2);
  const RewardDifference found = reward_difference(stubborn(1), integer(stubborn(2)), {}, episodes);
  EXPECT_NEAR(found.float_mean, mean_of(stops), 1e-9);
  EXPECT_NEAR(found.integer_mean, mean_of(backs), 1e-9);
  const double lost = mean_of(stops) - mean_of(backs);
  ASSERT_GT(std::abs(lost), 0.1);
  std::vector<double> squares;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    squares.push_back(std::pow(stops[i] - backs[i] - lost, 2));
  }
  EXPECT_NEAR(found.standard_error, std::sqrt(mean_of(squares) / episodes), 1e-9);
}

}  // namespace
}  // namespace striker::training

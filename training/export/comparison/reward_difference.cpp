// SPDX-License-Identifier: Apache-2.0
#include "training/export/comparison/reward_difference.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "training/task/environments.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

template <Environment E>
RewardDifference played(E& env, const Parameters& parameters, const IntegerNetwork& network, int episodes,
                        const EpisodePlayed& done) {
  GreedyRule greedy(parameters);
  const auto by_integers = [&network](const E& seen) {
    return static_cast<int>(evaluate(network, seen.raw()).action);
  };
  RewardDifference result{.episodes = episodes};
  double squares = 0.0;
  for (int i = 0; i < episodes; ++i) {
    const std::uint64_t episode = first_reward_difference_episode + static_cast<std::uint64_t>(i);
    const double exact = play(env, reward_difference_seed, episode, greedy).reward;
    const double integer = play(env, reward_difference_seed, episode, by_integers).reward;
    result.float_mean += exact / episodes;
    result.integer_mean += integer / episodes;
    squares += (integer - exact) * (integer - exact) / episodes;
    done();
  }
  const double mean = result.integer_mean - result.float_mean;
  result.standard_error = std::sqrt(std::max(0.0, squares - mean * mean) / episodes);
  return result;
}

}  // namespace

RewardDifference reward_difference(const Parameters& parameters, const IntegerNetwork& network,
                                   TaskConfig task, int episodes, const EpisodePlayed& done) {
  task.physics = Physics::full;
  task.velocities = Velocities::estimated;
  AnyEnvironment environment = make_environment(task);
  return std::visit([&](auto& env) { return played(env, parameters, network, episodes, done); }, environment);
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/run/evaluation.hpp"

#include <variant>

#include "training/task/environments.hpp"

namespace striker::training {

double mean_reward(const TaskConfig& task, const Parameters& parameters, std::uint64_t seed,
                   std::uint64_t first_episode, int count) {
  GreedyRule greedy(parameters);
  double sum = 0.0;
  AnyEnvironment environment = make_environment(task);
  std::visit(
      [&](auto& env) {
        for (int i = 0; i < count; ++i) {
          sum += play(env, seed, first_episode + static_cast<std::uint64_t>(i), greedy).reward;
        }
      },
      environment);
  return sum / count;
}

}  // namespace striker::training

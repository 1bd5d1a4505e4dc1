// SPDX-License-Identifier: Apache-2.0
#include "training/run/evaluation.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <variant>

#include "sil/world/random_streams.hpp"
#include "training/run/config.hpp"
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

Conditions conditions_of(const std::vector<std::string>& settings) {
  std::vector<std::string> changes = {"learner.kind=\"rollout\""};
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    if (equals == std::string::npos || key == "share" || key == "ramp_episodes") {
      throw std::runtime_error(fmt::format(
          "--condition {}: give a range's key of [randomise] and one value, such as mass=-0.3", setting));
    }
    const std::string value = setting.substr(equals + 1);
    changes.push_back(fmt::format("randomise.{0}=[{1}, {1}]", key, value));
  }
  sil::Random none(0, 0, sil::random_stream::conditions);
  return draw_conditions(parse_config("", "--condition", changes).environments.front().randomise, 1.0, none);
}

}  // namespace striker::training

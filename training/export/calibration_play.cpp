// SPDX-License-Identifier: Apache-2.0
#include "training/export/calibration_play.hpp"

#include <variant>

#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"
#include "training/task/environments.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

constexpr std::uint64_t calibration_seed = 1;

template <Environment E>
std::vector<RawState> states_met(E& env, GreedyRule& greedy, std::size_t actions, int first, int count,
                                 const EpisodePlayed& played) {
  std::vector<RawState> states;
  const auto collect = [&states](const E& seen) {
    if (!seen.success()) {
      states.push_back(seen.raw());
    }
  };
  for (int i = first; i < first + count; ++i) {
    const std::uint64_t episode = first_calibration_episode + static_cast<std::uint64_t>(i);
    play(env, calibration_seed, episode, [&](const E& seen) {
      collect(seen);
      return greedy(seen);
    });
    sil::Random random(calibration_seed, episode, sil::random_stream::calibration);
    play(env, calibration_seed, episode, [&](const E& seen) {
      collect(seen);
      return static_cast<int>(random.below(actions));
    });
    played();
  }
  return states;
}

}  // namespace

std::vector<RawState> calibration_play(const Parameters& parameters, TaskConfig task, int first, int count,
                                       const EpisodePlayed& played) {
  task.physics = Physics::full;
  AnyEnvironment environment = make_environment(task);
  GreedyRule greedy(parameters);
  return std::visit(
      [&](auto& env) { return states_met(env, greedy, task.actions.size(), first, count, played); },
      environment);
}

}  // namespace striker::training

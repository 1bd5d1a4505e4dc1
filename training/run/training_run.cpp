// SPDX-License-Identifier: Apache-2.0
#include "training/run/training_run.hpp"

#include <fmt/format.h>

#include <map>
#include <numeric>

#include "training/run/evaluation.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

std::map<std::string, std::string> metadata_of(const Training& training, const Parameters& parameters,
                                               int episodes) {
  std::map<std::string, std::string> metadata = {{"configuration", training.config().text},
                                                 {"configuration_name", training.config().name},
                                                 {"episodes", std::to_string(episodes)},
                                                 {"identity", model_identity(parameters)},
                                                 {"seed", std::to_string(training.seed())}};
  if (!training.state().history.empty()) {
    metadata["history"] = training.state().history;
  }
  return metadata;
}

std::vector<AnyEnvironment> make_environments(const Config& config) {
  std::vector<AnyEnvironment> environments;
  for (const TaskConfig& task : config.environments) {
    environments.push_back(make_environment(task));
  }
  return environments;
}

}  // namespace

Training::Training(const Config& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      environments_(make_environments(config)),
      learner_(setup_of(config), seed) {
  state_.recent_rewards.reserve(moving_average_span);
}

CurveRow Training::play_episode() {
  const std::uint64_t number = first_training_episode + static_cast<std::uint64_t>(state_.episodes);
  CurveRow row;
  row.episode = std::visit(
      [&](auto& env) {
        env.reset(seed_, number);
        return learner_.play(env, state_.episodes);
      },
      environments_[number % environments_.size()]);
  ++state_.episodes;
  std::vector<double>& recent = state_.recent_rewards;
  if (recent.size() == moving_average_span) {
    recent.erase(recent.begin());
  }
  recent.push_back(row.episode.reward);
  row.moving_average =
      std::accumulate(recent.begin(), recent.end(), 0.0) / static_cast<double>(recent.size());
  return row;
}

void Training::begin_from(const Parameters& parameters) {
  learner_.begin_from(parameters);
  state_.history = fmt::format("begun from the network {}", model_identity(parameters));
}

void Training::note_best(double mean, const Parameters& parameters) {
  state_.best_episodes = state_.episodes;
  state_.best_mean = mean;
  state_.best_values = parameters.values;
}

void Training::save(const std::filesystem::path& checkpoint) const {
  save_checkpoint(checkpoint, config_, seed_, learner_, state_);
}

void Training::resume(const std::filesystem::path& checkpoint) {
  state_ = load_checkpoint(checkpoint, config_, seed_, learner_);
}

double validation_mean(const Training& training, const Parameters& parameters) {
  const Config& config = training.config();
  return mean_reward(config.environments.front(), parameters, training.seed(), first_validation_episode,
                     config.run.validation_episodes);
}

Model model_of(const Training& training) {
  const Parameters parameters = training.learner().result();
  return {.parameters = parameters, .metadata = metadata_of(training, parameters, training.episodes())};
}

Model best_model_of(const Training& training) {
  const RunState& state = training.state();
  Parameters parameters = training.learner().result();
  parameters.values = state.best_values;
  Model model{.parameters = parameters, .metadata = metadata_of(training, parameters, state.best_episodes)};
  model.metadata["mean_reward"] = fmt::format("{:.3f}", state.best_mean);
  return model;
}

}  // namespace striker::training

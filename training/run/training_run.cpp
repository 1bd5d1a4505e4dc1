// SPDX-License-Identifier: Apache-2.0
#include "training/run/training_run.hpp"

#include <fmt/format.h>

#include <algorithm>
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
      learner_(make_learner(config, seed)) {
  state_.recent_rewards.reserve(moving_average_span);
  rows_.reserve(1);
}

std::span<const CurveRow> Training::play_round() {
  rows_.clear();
  if (auto* const dqn = std::get_if<Learner>(&learner_)) {
    add_row(play_episode(*dqn));
  } else {
    const int count = std::min(config_.rollout.round_episodes, config_.run.episodes - state_.episodes);
    for (const EpisodeRow& episode : std::get<RolloutLearner>(learner_).play_round(state_.episodes, count)) {
      add_row(episode);
    }
  }
  return rows_;
}

EpisodeRow Training::play_episode(Learner& learner) {
  const std::uint64_t number = first_training_episode + static_cast<std::uint64_t>(state_.episodes);
  return std::visit(
      [&](auto& env) {
        env.reset(seed_, number);
        return learner.play(env, state_.episodes);
      },
      environments_[number % environments_.size()]);
}

void Training::add_row(const EpisodeRow& episode) {
  ++state_.episodes;
  std::vector<double>& recent = state_.recent_rewards;
  if (recent.size() == moving_average_span) {
    recent.erase(recent.begin());
  }
  recent.push_back(episode.reward);
  const double sum = std::accumulate(recent.begin(), recent.end(), 0.0);
  rows_.push_back({.episode = episode, .moving_average = sum / static_cast<double>(recent.size())});
}

std::int64_t Training::decisions() const {
  return std::visit([](const auto& learner) { return learner.state().decisions; }, learner_);
}

std::int64_t Training::gradient_steps() const {
  return std::visit([](const auto& learner) { return learner.state().gradient_steps; }, learner_);
}

void Training::begin_from(const Parameters& parameters) {
  std::visit([&](auto& learner) { learner.begin_from(parameters); }, learner_);
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
  const Parameters parameters = training.result();
  return {.parameters = parameters, .metadata = metadata_of(training, parameters, training.episodes())};
}

Model best_model_of(const Training& training) {
  const RunState& state = training.state();
  Parameters parameters = training.result();
  parameters.values = state.best_values;
  Model model{.parameters = parameters, .metadata = metadata_of(training, parameters, state.best_episodes)};
  model.metadata["mean_reward"] = fmt::format("{:.3f}", state.best_mean);
  return model;
}

}  // namespace striker::training

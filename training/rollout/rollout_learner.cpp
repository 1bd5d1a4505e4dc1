// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/rollout_learner.hpp"

#include <algorithm>
#include <cmath>

#include "sil/world/random_streams.hpp"
#include "training/learner/course.hpp"
#include "training/learner/divergence.hpp"

namespace striker::training {

namespace {

RolloutState initial_rollout_state(const LearnerSetup& setup, std::uint64_t seed) {
  const Parameters parameters = initial_parameters(setup.shape, seed);
  return {.online = parameters,
          .average = parameters,
          .adam = Adam(parameters.values.size()),
          .labels = LabelStore(setup.shape.inputs, setup.shape.actions, setup.learner.replay_size),
          .exploring = sil::Random(seed, 0, sil::random_stream::exploration),
          .sampling = sil::Random(seed, 0, sil::random_stream::sampling)};
}

}  // namespace

RolloutLearner::RolloutLearner(const LearnerSetup& setup, const std::vector<TaskConfig>& tasks,
                               std::uint64_t seed)
    : setup_(setup),
      seed_(seed),
      state_(initial_rollout_state(setup, seed)),
      rollouts_(setup.shape, setup.rollout, tasks),
      places_(static_cast<std::size_t>(setup.learner.batch)),
      sampled_(setup.shape.inputs, setup.learner.batch),
      q_gradient_(setup.shape.actions, setup.learner.batch),
      pass_(setup.shape, setup.learner.batch),
      gradient_(state_.online.values.size()) {}

void RolloutLearner::begin_from(const Parameters& parameters) {
  state_.online = parameters;
  state_.average = parameters;
}

std::vector<EpisodeRow> RolloutLearner::play_round(int first, int count) {
  const double progress = share_of(first, setup_.planned_episodes);
  const ExplorationConfig& exploration = setup_.exploration;
  const RoundPlan plan{
      .seed = seed_,
      .first_episode = first,
      .episodes = count,
      .epsilon = course(exploration.schedule, exploration.epsilon_start, exploration.epsilon_end,
                        share_of(first, exploration.decay_episodes)),
      .by_plans = first < setup_.rollout.planner_episodes};
  std::vector<EpisodeRow> rows = rollouts_.round(state_.average, plan, state_.exploring, state_.labels);
  const OptimiserConfig& optimiser = setup_.optimiser;
  EpisodeRow figures{.episode = first};
  figures.learning_rate = course(optimiser.schedule, optimiser.learning_rate,
                                 optimiser.learning_rate * optimiser.final_fraction, progress);
  const PreferenceLoss loss = loss_at(progress);
  const std::int64_t before = state_.gradient_steps;
  while (due()) {
    learn(loss, figures);
  }
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, state_.gradient_steps - before));
  for (EpisodeRow& row : rows) {
    state_.decisions += row.decisions;
    row.learning_rate = figures.learning_rate;
    row.loss = figures.loss / steps;
    row.td_error = figures.td_error / steps;
    row.q = figures.q / steps;
  }
  return rows;
}

// Each label is drawn `passes` times, on the average.
bool RolloutLearner::due() const {
  const std::int64_t labels = state_.labels.pushed();
  return labels >= setup_.learner.warm_up &&
         static_cast<double>(state_.gradient_steps + 1) * setup_.learner.batch <=
             setup_.rollout.passes * static_cast<double>(labels);
}

PreferenceLoss RolloutLearner::loss_at(double progress) const {
  const RolloutConfig& config = setup_.rollout;
  const bool first_part = progress < config.pairwise_share;
  return {.pairwise = first_part ? 1.0F : static_cast<float>(config.pairwise_rest),
          .expected = first_part ? 0.0F : 1.0F,
          .value = static_cast<float>(config.value_weight),
          .temperature = static_cast<float>(config.temperature),
          .greatest_regret = static_cast<float>(config.greatest_regret)};
}

// One gradient step; adds the batch's figures.
void RolloutLearner::learn(const PreferenceLoss& loss, EpisodeRow& figures) {
  sample();
  require_finite(std::isfinite(differentiate(loss, figures)), "the loss", figures.episode);
  backward(state_.online, sampled_, pass_, q_gradient_, gradient_);
  state_.adam.step(state_.online.values, gradient_, figures.learning_rate);
  require_finite(all_finite(state_.online.values), "a weight", figures.episode);
  ++state_.gradient_steps;
  // The mean of all weights so far, until there are as many as are averaged.
  const double young = 1.0 - 1.0 / static_cast<double>(state_.gradient_steps);
  const auto share = static_cast<float>(1.0 - std::min(setup_.optimiser.averaging, young));
  state_.average.values += share * (state_.online.values - state_.average.values);
}

void RolloutLearner::sample() {
  const auto held = static_cast<std::uint64_t>(state_.labels.size());
  for (Eigen::Index i = 0; i < sampled_.cols(); ++i) {
    const auto place = static_cast<Eigen::Index>(state_.sampling.below(held));
    places_[static_cast<std::size_t>(i)] = place;
    sampled_.col(i) = state_.labels.features(place);
  }
}

float RolloutLearner::differentiate(const PreferenceLoss& loss, EpisodeRow& figures) {
  forward(state_.online, sampled_, pass_);
  float sum = 0.0F;
  const float share = 1.0F / static_cast<float>(sampled_.cols());
  double errors = 0.0;
  double values = 0.0;
  for (Eigen::Index i = 0; i < sampled_.cols(); ++i) {
    const Eigen::Index place = places_[static_cast<std::size_t>(i)];
    const PreferenceFigures of_state =
        training::differentiate(loss, pass_.q.col(i), state_.labels.values(place), q_gradient_.col(i));
    const float weight = share * state_.labels.weight(place);
    q_gradient_.col(i) *= weight;
    sum += weight * of_state.loss;
    errors += static_cast<double>(std::abs(of_state.value_error));
    values += static_cast<double>(pass_.q.col(i).maxCoeff());
  }
  figures.loss += static_cast<double>(sum);
  figures.td_error += errors / static_cast<double>(sampled_.cols());
  figures.q += values / static_cast<double>(sampled_.cols());
  return sum;
}

void RolloutLearner::require_finite(bool finite, const char* what, int episode) const {
  if (!finite) {
    throw Divergence(what, episode, state_.gradient_steps + 1);
  }
}

Parameters RolloutLearner::result() const {
  return folded(state_.average);
}

}  // namespace striker::training

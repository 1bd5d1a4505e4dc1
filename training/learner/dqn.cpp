// SPDX-License-Identifier: Apache-2.0
#include "training/learner/dqn.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sil/world/random_streams.hpp"
#include "training/learner/course.hpp"
#include "training/learner/divergence.hpp"

namespace striker::training {

namespace {

LearnerState initial_state(const LearnerSetup& setup, std::uint64_t seed) {
  const Parameters parameters = initial_parameters(setup.shape, seed);
  const LearnerConfig& config = setup.learner;
  return {.online = parameters,
          .target = parameters,
          .average = parameters,
          .adam = Adam(parameters.values.size()),
          .replay = ReplayBuffer(setup.shape.inputs, config.replay_size),
          .priorities = Priorities(config.prioritised ? static_cast<std::size_t>(config.replay_size) : 1,
                                   config.priority_exponent),
          .choosing = sil::Random(seed, 0, sil::random_stream::exploration),
          .sampling = sil::Random(seed, 0, sil::random_stream::sampling)};
}

}  // namespace

Parameters initial_parameters(const Shape& shape, std::uint64_t seed) {
  sil::Random random(seed, 0, sil::random_stream::weights);
  Parameters parameters(shape);
  for (int layer = 0; layer < shape.layers(); ++layer) {
    auto weights = parameters.weights(layer);
    const double limit = std::sqrt(6.0 / static_cast<double>(weights.cols()));
    for (float& weight : weights.reshaped()) {
      weight = static_cast<float>(random.uniform(-limit, limit));
    }
  }
  return parameters;
}

Learner::Learner(const LearnerSetup& setup, std::uint64_t seed)
    : config_(setup.learner),
      optimiser_(setup.optimiser),
      exploration_(setup.exploration),
      planned_episodes_(setup.planned_episodes),
      mirror_(setup.mirror),
      state_(initial_state(setup, seed)),
      rounded_(state_.online),
      n_step_(config_.n_step, config_.gamma, setup.shape.inputs),
      places_(static_cast<std::size_t>(config_.batch)),
      actions_(static_cast<std::size_t>(config_.batch)),
      sampled_(setup.shape.inputs, config_.batch),
      sampled_next_(setup.shape.inputs, config_.batch),
      q_gradient_(setup.shape.actions, config_.batch),
      td_errors_(config_.batch),
      sample_weights_(Eigen::VectorXf::Ones(config_.batch)),
      pass_(setup.shape, config_.batch),
      next_pass_(setup.shape, config_.batch),
      choosing_pass_(setup.shape, config_.batch),
      gradient_(state_.online.values.size()),
      actor_(setup.shape),
      features_(setup.shape.inputs),
      next_features_(setup.shape.inputs) {
  round_online();
}

void Learner::begin_from(const Parameters& parameters) {
  state_.online = parameters;
  state_.target = parameters;
  state_.average = parameters;
  round_online();
}

void Learner::resume(LearnerState state) {
  state_ = std::move(state);
  round_online();
}

// An episode's schedules: exploration over its own number of episodes, the learning rate over the whole
// training.
EpisodeRow Learner::begin_episode(int episode) {
  progress_ = share_of(episode, planned_episodes_);
  EpisodeRow row{.episode = episode};
  row.epsilon = course(exploration_.schedule, exploration_.epsilon_start, exploration_.epsilon_end,
                       share_of(episode, exploration_.decay_episodes));
  row.learning_rate = course(optimiser_.schedule, optimiser_.learning_rate,
                             optimiser_.learning_rate * optimiser_.final_fraction, progress_);
  return row;
}

int Learner::choose(const Features& features, double epsilon) {
  exploring_ = state_.choosing.uniform() < epsilon;
  if (exploring_) {
    return static_cast<int>(state_.choosing.below(static_cast<std::uint64_t>(q_gradient_.rows())));
  }
  return actor_.choose(played(), features);
}

void Learner::remember(const Features& features, int action, double reward, const Features& next, bool end,
                       bool truncated) {
  const auto push = [this](const Transition& transition) {
    const Eigen::Index place = state_.replay.push(transition);
    if (config_.prioritised) {
      state_.priorities.insert(static_cast<std::size_t>(place));
    }
  };
  if (config_.cut_at_exploration && exploring_) {
    n_step_.cut(features, push);
  }
  n_step_.take(features, action, reward, next, end, push, truncated && config_.time_limit);
  ++state_.decisions;
}

bool Learner::warm() const {
  return state_.decisions >= config_.warm_up && state_.replay.size() >= config_.batch;
}

// One gradient step; adds the batch's figures to the row.
void Learner::learn(EpisodeRow& row) {
  sample();
  const double loss = differentiate(row);
  require_finite(std::isfinite(row.q), "a Q value", row.episode);
  require_finite(std::isfinite(loss), "the loss", row.episode);
  row.loss += loss;
  backward(played(), sampled_, pass_, q_gradient_, gradient_);
  if (config_.clip_norm > 0.0) {
    const float norm = gradient_.norm();
    const auto limit = static_cast<float>(config_.clip_norm);
    gradient_ *= norm > limit ? limit / norm : 1.0F;
  }
  state_.adam.step(state_.online.values, gradient_, row.learning_rate);
  require_finite(all_finite(state_.online.values), "a weight", row.episode);
  round_online();
  ++state_.gradient_steps;
  if (config_.prioritised) {
    update_priorities();
  }
  follow();
}

void Learner::require_finite(bool finite, const char* what, int episode) const {
  if (!finite) {
    throw Divergence(what, episode, state_.gradient_steps + 1);
  }
}

// Those that no gradient step looks at, too.
void Learner::require_finite_weights(int episode) const {
  const bool finite = all_finite(state_.online.values) && all_finite(state_.target.values) &&
                      all_finite(state_.average.values);
  require_finite(finite, "a weight", episode);
}

void Learner::sample() {
  const auto held = static_cast<std::uint64_t>(state_.replay.size());
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    const auto place = static_cast<Eigen::Index>(
        config_.prioritised ? state_.priorities.at(state_.sampling.uniform()) : state_.sampling.below(held));
    const int action = state_.replay.action(place);
    const bool mirror = config_.augment_mirrored && state_.sampling.below(2) == 1;
    const auto slot = static_cast<std::size_t>(i);
    places_[slot] = place;
    actions_[slot] = mirror ? mirror_.actions[static_cast<std::size_t>(action)] : action;
    sampled_.col(i) = state_.replay.state(place);
    sampled_next_.col(i) = state_.replay.next(place);
    if (mirror) {
      sampled_.col(i).array() *= mirror_.factors.array();
      sampled_next_.col(i).array() *= mirror_.factors.array();
    }
  }
  if (config_.prioritised) {
    weigh_samples();
  }
}

// The loss and its gradient by the Q values: the TD error of the actions taken, squared or Huber's.
double Learner::differentiate(EpisodeRow& row) {
  forward(state_.target, sampled_next_, next_pass_);
  if (config_.double_dqn) {
    forward(played(), sampled_next_, choosing_pass_);
  }
  forward(played(), sampled_, pass_);
  q_gradient_.setZero();
  double loss = 0.0;
  double error_sum = 0.0;
  double q_sum = 0.0;
  const float share = 1.0F / static_cast<float>(config_.batch);
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    const Eigen::Index place = places_[static_cast<std::size_t>(i)];
    const int action = actions_[static_cast<std::size_t>(i)];
    const float target = state_.replay.reward(place) + state_.replay.discount(place) * value_of_next(i);
    const float error = pass_.q(action, i) - target;
    const float weight = sample_weights_[i] * share;
    const bool linear = config_.huber && std::abs(error) > 1.0F;
    loss += static_cast<double>(weight * (linear ? 2.0F * std::abs(error) - 1.0F : error * error));
    q_gradient_(action, i) = 2.0F * weight * (linear ? std::copysign(1.0F, error) : error);
    td_errors_[i] = error;
    error_sum += static_cast<double>(std::abs(error));
    q_sum += static_cast<double>(pass_.q(action, i));
  }
  row.td_error += error_sum / config_.batch;
  row.q += q_sum / config_.batch;
  return loss;
}

// max Q of the target network, or (Double DQN, van Hasselt et al. 2016) its value of the online network's
// choice.
float Learner::value_of_next(Eigen::Index i) const {
  const auto& choosing = config_.double_dqn ? choosing_pass_.q : next_pass_.q;
  return next_pass_.q(greedy_action(choosing.col(i)), i);
}

// Importance sampling: the weights undo, more and more, that urgent transitions come too often (Schaul et al.
// 2016, section 3.4).
void Learner::weigh_samples() {
  const double correction = course(Course::linear, config_.priority_correction, 1.0, progress_);
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    const auto place = static_cast<std::size_t>(places_[static_cast<std::size_t>(i)]);
    const double often = static_cast<double>(state_.replay.size()) * state_.priorities.probability(place);
    sample_weights_[i] = static_cast<float>(std::pow(often, -correction));
  }
  sample_weights_ /= sample_weights_.maxCoeff();
}

void Learner::update_priorities() {
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    state_.priorities.update(static_cast<std::size_t>(places_[static_cast<std::size_t>(i)]),
                             static_cast<double>(td_errors_[i]));
  }
}

void Learner::round_online() {
  if (config_.int8_weights) {
    round_to_int8(state_.online, rounded_);
  }
}

// The target network and the average follow the online network.
void Learner::follow() {
  if (state_.gradient_steps % config_.target_period == 0) {
    if (config_.target_rate == 1.0) {
      state_.target.values = played().values;
    } else {
      state_.target.values +=
          static_cast<float>(config_.target_rate) * (played().values - state_.target.values);
    }
  }
  if (optimiser_.averaging > 0.0) {
    state_.average.values +=
        static_cast<float>(1.0 - optimiser_.averaging) * (state_.online.values - state_.average.values);
  }
}

Parameters Learner::result() const {
  Parameters result = optimiser_.averaging > 0.0 ? state_.average : state_.online;
  if (config_.int8_weights) {
    round_to_int8(Parameters(result), result);
  }
  return folded(result);
}

}  // namespace striker::training

#include "training/learner/dqn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace striker::training {

namespace {

// Every use of randomness has a stream of its own.
constexpr std::uint64_t weights_stream = 101;
constexpr std::uint64_t exploration_stream = 102;
constexpr std::uint64_t sampling_stream = 103;

// From start to end as `share` goes from 0 to 1, and end after that.
double course(Course form, double start, double end, double share) {
  const double at = std::clamp(share, 0.0, 1.0);
  switch (form) {
    case Course::exponential:
      return start * std::pow(std::max(end, 1e-6) / std::max(start, 1e-6), at);
    case Course::cosine:
      return end + (start - end) * 0.5 * (1.0 + std::cos(std::numbers::pi * at));
    case Course::linear:
      break;
  }
  return start + (end - start) * at;
}

double share_of(int part, int whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

Parameters initial_parameters(const Shape& shape, std::uint64_t seed) {
  sil::Random random(seed, 0, weights_stream);
  Parameters parameters(shape);
  for (int layer = 0; layer < layer_count; ++layer) {
    auto weights = parameters.weights(layer);
    const double limit = std::sqrt(6.0 / static_cast<double>(weights.cols()));
    for (float& weight : weights.reshaped()) {
      weight = static_cast<float>(random.uniform(-limit, limit));
    }
  }
  return parameters;
}

Learner::Learner(const Config& config, std::uint64_t seed)
    : config_(config.learner),
      optimiser_(config.optimiser),
      exploration_(config.exploration),
      episodes_(config.run.episodes),
      online_(initial_parameters(config.shape, seed)),
      rounded_(online_),
      target_(online_),
      average_(online_),
      adam_(online_.values.size()),
      replay_(config.shape.inputs, config_.replay_size),
      priorities_(config_.prioritised ? static_cast<std::size_t>(config_.replay_size) : 1,
                  config_.priority_exponent),
      n_step_(config_.n_step, config_.gamma, config.shape.inputs),
      choosing_(seed, 0, exploration_stream),
      sampling_(seed, 0, sampling_stream),
      places_(static_cast<std::size_t>(config_.batch)),
      actions_(static_cast<std::size_t>(config_.batch)),
      states_(config.shape.inputs, config_.batch),
      next_states_(config.shape.inputs, config_.batch),
      q_gradient_(config.shape.actions, config_.batch),
      td_errors_(config_.batch),
      sample_weights_(Eigen::VectorXf::Ones(config_.batch)),
      mirror_factors_(mirror_factors(config.environments.front().inputs)),
      pass_(config.shape, config_.batch),
      next_pass_(config.shape, config_.batch),
      choosing_pass_(config.shape, config_.batch),
      gradient_(online_.values.size()),
      actor_(config.shape),
      state_(config.shape.inputs),
      next_state_(config.shape.inputs) {
  for (int action = 0; action < config.shape.actions; ++action) {
    mirrored_actions_.push_back(mirrored_action(config.environments.front().actions, action));
  }
  round_online();
}

// The contact ends the episode (unless the configuration lets it go on), and so does decision 40: the learner
// never looks past it.
EpisodeRow Learner::play(KickEnv& env, int episode) {
  progress_ = share_of(episode, episodes_);
  EpisodeRow row{.episode = episode};
  row.epsilon = course(exploration_.schedule, exploration_.epsilon_start, exploration_.epsilon_end,
                       share_of(episode, exploration_.decay_episodes));
  row.learning_rate = course(optimiser_.schedule, optimiser_.learning_rate,
                             optimiser_.learning_rate * optimiser_.final_fraction, progress_);
  const std::int64_t steps_before = gradient_steps_;
  state_ = env.features();
  for (bool end = false; !end; ++row.steps) {
    const int action = choose(state_, row.epsilon);
    const StepResult result = env.step(action);
    end = result.end;
    next_state_ = env.features();
    remember(state_, action, result.reward, next_state_, end);
    state_.swap(next_state_);
    for (int i = 0; warm() && i < config_.gradient_steps; ++i) {
      learn(row);
    }
  }
  row.reward = env.outcome().reward;
  row.contact = env.outcome().contact;
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, gradient_steps_ - steps_before));
  row.loss /= steps;
  row.td_error /= steps;
  row.q /= steps;
  return row;
}

int Learner::choose(const Features& state, double epsilon) {
  exploring_ = choosing_.uniform() < epsilon;
  if (exploring_) {
    return static_cast<int>(choosing_.below(static_cast<std::uint64_t>(q_gradient_.rows())));
  }
  return actor_.choose(played(), state);
}

void Learner::remember(const Features& state, int action, double reward, const Features& next, bool end) {
  const auto push = [this](const Transition& transition) {
    const Eigen::Index place = replay_.push(transition);
    if (config_.prioritised) {
      priorities_.insert(static_cast<std::size_t>(place));
    }
  };
  if (config_.cut_at_exploration && exploring_) {
    n_step_.cut(state, push);
  }
  n_step_.take(state, action, reward, next, end, push);
  ++decisions_;
}

bool Learner::warm() const {
  return decisions_ >= config_.warm_up && replay_.size() >= config_.batch;
}

// One gradient step; adds the batch's figures to the row.
void Learner::learn(EpisodeRow& row) {
  sample();
  row.loss += differentiate(row);
  backward(played(), states_, pass_, q_gradient_, gradient_);
  if (config_.clip_norm > 0.0) {
    const float norm = gradient_.norm();
    const auto limit = static_cast<float>(config_.clip_norm);
    gradient_ *= norm > limit ? limit / norm : 1.0F;
  }
  adam_.step(online_.values, gradient_, row.learning_rate);
  round_online();
  ++gradient_steps_;
  if (config_.prioritised) {
    update_priorities();
  }
  follow();
}

void Learner::sample() {
  const auto held = static_cast<std::uint64_t>(replay_.size());
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    const auto place = static_cast<Eigen::Index>(config_.prioritised ? priorities_.at(sampling_.uniform())
                                                                     : sampling_.below(held));
    const int action = replay_.action(place);
    const bool mirror = config_.mirror && sampling_.below(2) == 1;
    const auto slot = static_cast<std::size_t>(i);
    places_[slot] = place;
    actions_[slot] = mirror ? mirrored_actions_[static_cast<std::size_t>(action)] : action;
    states_.col(i) = replay_.state(place);
    next_states_.col(i) = replay_.next(place);
    if (mirror) {
      states_.col(i).array() *= mirror_factors_.array();
      next_states_.col(i).array() *= mirror_factors_.array();
    }
  }
  if (config_.prioritised) {
    weigh_samples();
  }
}

// The loss and its gradient by the Q values: the TD error of the actions taken, squared or Huber's.
double Learner::differentiate(EpisodeRow& row) {
  forward(target_, next_states_, next_pass_);
  if (config_.double_dqn) {
    forward(played(), next_states_, choosing_pass_);
  }
  forward(played(), states_, pass_);
  q_gradient_.setZero();
  double loss = 0.0;
  double error_sum = 0.0;
  double q_sum = 0.0;
  const float share = 1.0F / static_cast<float>(config_.batch);
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    const Eigen::Index place = places_[static_cast<std::size_t>(i)];
    const int action = actions_[static_cast<std::size_t>(i)];
    const float target = replay_.reward(place) + replay_.discount(place) * value_of_next(i);
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
    const double often = static_cast<double>(replay_.size()) * priorities_.probability(place);
    sample_weights_[i] = static_cast<float>(std::pow(often, -correction));
  }
  sample_weights_ /= sample_weights_.maxCoeff();
}

void Learner::update_priorities() {
  for (Eigen::Index i = 0; i < config_.batch; ++i) {
    priorities_.update(static_cast<std::size_t>(places_[static_cast<std::size_t>(i)]),
                       static_cast<double>(td_errors_[i]));
  }
}

void Learner::round_online() {
  if (config_.int8_weights) {
    round_to_int8(online_, rounded_);
  }
}

// The target network and the average follow the online network.
void Learner::follow() {
  if (gradient_steps_ % config_.target_period == 0) {
    if (config_.target_rate == 1.0) {
      target_.values = played().values;
    } else {
      target_.values += static_cast<float>(config_.target_rate) * (played().values - target_.values);
    }
  }
  if (optimiser_.averaging > 0.0) {
    average_.values += static_cast<float>(1.0 - optimiser_.averaging) * (online_.values - average_.values);
  }
}

Parameters Learner::result() const {
  Parameters result = optimiser_.averaging > 0.0 ? average_ : online_;
  if (config_.int8_weights) {
    round_to_int8(Parameters(result), result);
  }
  return folded(result);
}

}  // namespace striker::training

#include "dqn.hpp"

#include <algorithm>
#include <cmath>

#include "replay.hpp"
#include "world/random.hpp"

namespace striker::training {

namespace {

// Every use of randomness has a stream of its own.
constexpr std::uint64_t weights_stream = 101;
constexpr std::uint64_t exploration_stream = 102;
constexpr std::uint64_t sampling_stream = 103;

class Learner {
 public:
  Learner(const LearnerConfig& config, std::uint64_t seed)
      : config_(config),
        online_(initial_parameters(seed)),
        target_(online_),
        replay_(static_cast<std::size_t>(config.replay_size)),
        folder_(config.n_step, config.gamma),
        exploration_(seed, 0, exploration_stream),
        sampling_(seed, 0, sampling_stream),
        states_(state_elements, config.batch),
        next_states_(state_elements, config.batch),
        q_gradient_(actions, config.batch),
        batch_(static_cast<std::size_t>(config.batch)),
        pass_(config.batch),
        next_pass_(config.batch),
        choosing_pass_(config.batch) {}

  int choose(const Features& state, double epsilon) {
    if (exploration_.uniform() < epsilon) {
      return static_cast<int>(exploration_.below(actions));
    }
    return greedy_action(q_values(online_, state));
  }

  void remember(const Features& state, int action, double reward, const Features& next, bool end) {
    folder_.take(state, action, reward, next, end, replay_);
    ++decisions_;
  }

  [[nodiscard]] bool warm() const {
    return decisions_ >= config_.warm_up && replay_.size() >= static_cast<std::size_t>(config_.batch);
  }

  // One gradient step; returns the batch's mean loss.
  double learn(double learning_rate) {
    sample();
    const double loss = differentiate();
    backward(online_, states_, pass_, q_gradient_, gradient_);
    adam_.step(online_, gradient_, learning_rate);
    ++gradient_steps_;
    if (gradient_steps_ % config_.target_period == 0) {
      target_ = online_;
    }
    return loss;
  }

  [[nodiscard]] const Parameters& parameters() const { return online_; }
  [[nodiscard]] std::int64_t decisions() const { return decisions_; }
  [[nodiscard]] std::int64_t gradient_steps() const { return gradient_steps_; }

 private:
  void sample() {
    for (int i = 0; i < config_.batch; ++i) {
      const Transition& transition = replay_[sampling_.below(replay_.size())];
      const bool mirror = config_.mirror && sampling_.below(2) == 1;
      states_.col(i) = mirror ? mirrored(transition.state) : transition.state;
      next_states_.col(i) = mirror ? mirrored(transition.next) : transition.next;
      batch_[static_cast<std::size_t>(i)] = &transition;
    }
  }

  // The loss and its gradient by the Q values: the TD error of the actions taken, squared or Huber's.
  double differentiate() {
    forward(target_, next_states_, next_pass_);
    if (config_.double_dqn) {
      forward(online_, next_states_, choosing_pass_);
    }
    forward(online_, states_, pass_);
    q_gradient_.setZero();
    double loss = 0.0;
    const float share = 1.0F / static_cast<float>(config_.batch);
    for (int i = 0; i < config_.batch; ++i) {
      const Transition& transition = *batch_[static_cast<std::size_t>(i)];
      const float error =
          pass_.q(transition.action, i) - transition.reward - transition.discount * value_of_next(i);
      const bool linear = config_.huber && std::abs(error) > 1.0F;
      loss += linear ? 2.0F * std::abs(error) - 1.0F : error * error;
      q_gradient_(transition.action, i) = 2.0F * share * (linear ? std::copysign(1.0F, error) : error);
    }
    return loss / config_.batch;
  }

  // max Q of the target network, or (Double DQN, van Hasselt et al. 2016) its value of the online network's
  // choice.
  [[nodiscard]] float value_of_next(int i) const {
    const auto& choosing = config_.double_dqn ? choosing_pass_.q : next_pass_.q;
    return next_pass_.q(greedy_action(choosing.col(i)), i);
  }

  LearnerConfig config_;
  Parameters online_;
  Parameters target_;
  Parameters gradient_ = Parameters::Zero();
  Adam adam_;
  Replay replay_;
  StepFolder folder_;
  sil::Random exploration_;
  sil::Random sampling_;
  StateBatch states_;
  StateBatch next_states_;
  QBatch q_gradient_;
  std::vector<const Transition*> batch_;
  BatchPass pass_;
  BatchPass next_pass_;
  BatchPass choosing_pass_;
  std::int64_t decisions_ = 0;
  std::int64_t gradient_steps_ = 0;
};

double falling(double start, double end, int episode, int episodes) {
  return start + (end - start) * std::min(1.0, static_cast<double>(episode) / episodes);
}

// The contact ends the episode, and so does decision 40: the learner never looks past it.
EpisodeRow play_and_learn(const Config& config, int episode, KickEnv& env, Learner& learner) {
  const ExplorationConfig& exploration = config.exploration;
  const OptimiserConfig& optimiser = config.optimiser;
  EpisodeRow row{.episode = episode};
  row.epsilon =
      falling(exploration.epsilon_start, exploration.epsilon_end, episode, exploration.decay_episodes);
  const double learning_rate = falling(
      optimiser.learning_rate, optimiser.learning_rate * optimiser.final_fraction, episode, config.episodes);
  double loss = 0.0;
  int gradient_steps = 0;
  for (bool end = false; !end; ++row.steps) {
    const Features state = features(env.state());
    const int action = learner.choose(state, row.epsilon);
    const StepResult result = env.step(action);
    end = result.contact || result.last;
    learner.remember(state, action, result.reward, features(env.state()), end);
    for (int i = 0; learner.warm() && i < config.learner.gradient_steps; ++i) {
      loss += learner.learn(learning_rate);
      ++gradient_steps;
    }
  }
  row.reward = env.outcome().reward;
  row.contact = env.outcome().contact;
  row.loss = gradient_steps > 0 ? loss / gradient_steps : 0.0;
  return row;
}

double moving_average(const std::vector<EpisodeRow>& earlier, double reward) {
  const std::size_t span = std::min<std::size_t>(earlier.size(), moving_average_span - 1);
  double sum = reward;
  for (std::size_t i = earlier.size() - span; i < earlier.size(); ++i) {
    sum += earlier[i].reward;
  }
  return sum / static_cast<double>(span + 1);
}

}  // namespace

Parameters initial_parameters(std::uint64_t seed) {
  sil::Random random(seed, 0, weights_stream);
  Parameters parameters = Parameters::Zero();
  const auto fill = [&random](auto matrix) {
    const double limit = std::sqrt(6.0 / static_cast<double>(matrix.cols()));
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      matrix.data()[i] = static_cast<float>(random.uniform(-limit, limit));
    }
  };
  fill(weights<0>(parameters));
  fill(weights<1>(parameters));
  fill(weights<2>(parameters));
  return parameters;
}

Training train(const Config& config, std::uint64_t seed, const Progress& progress) {
  std::vector<KickEnv> envs;
  for (const EnvConfig& environment : config.environments) {
    envs.emplace_back(environment);
  }
  Learner learner(config.learner, seed);
  Training training;
  training.rows.reserve(static_cast<std::size_t>(config.episodes));
  for (int episode = 0; episode < config.episodes; ++episode) {
    const std::uint64_t number = training_episodes + static_cast<std::uint64_t>(episode);
    KickEnv& env = envs[number % envs.size()];
    env.reset(sil::draw_kick(seed, number, sil::PoseMode::origin));
    EpisodeRow row = play_and_learn(config, episode, env, learner);
    row.moving_average = moving_average(training.rows, row.reward);
    training.rows.push_back(row);
    if (!progress(row)) {
      break;
    }
  }
  training.parameters = learner.parameters();
  training.decisions = learner.decisions();
  training.gradient_steps = learner.gradient_steps();
  return training;
}

double validate(const Config& config, const Parameters& parameters, std::uint64_t seed) {
  KickEnv env(config.environments.front());
  const Choice choose = [&](const RcsState& state) {
    return greedy_action(q_values(parameters, features(state)));
  };
  double sum = 0.0;
  for (int i = 0; i < config.validation_episodes; ++i) {
    const std::uint64_t number = validation_episodes + static_cast<std::uint64_t>(i);
    sum += play(env, sil::draw_kick(seed, number, sil::PoseMode::origin), choose).reward;
  }
  return sum / config.validation_episodes;
}

}  // namespace striker::training

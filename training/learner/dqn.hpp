// SPDX-License-Identifier: Apache-2.0
// The learner: a deep Q network (Mnih et al. 2015) as in the paper, with the options of the configuration. An
// episode's decisions are below the class, the gradient step is dqn.cpp from top to bottom. It learns in any
// Environment.
//
//   Learner learner(setup, seed);
//   env.reset(seed, episode);
//   EpisodeRow row = learner.play(env, 0);
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "training/learner/learner_config.hpp"
#include "training/learner/learner_state.hpp"
#include "training/learner/network.hpp"
#include "training/task/environment.hpp"

namespace striker::training {

// What one episode of training was like.
struct EpisodeRow {
  int episode = 0;
  int decisions = 0;  // until the episode's end
  double reward = 0.0;
  bool success = false;  // for the kick: contact
  double epsilon = 0.0;
  double learning_rate = 0.0;
  // Means over the episode's gradient steps, 0 if there were none.
  double loss = 0.0;
  double td_error = 0.0;  // its absolute value
  double q = 0.0;         // of the actions in the samples
};

// Allocates nothing once made.
class Learner {
 public:
  Learner(const LearnerSetup& setup, std::uint64_t seed);

  // Plays training episode `episode` in `env`, which has been reset to its start, and learns from it: up to
  // `end`, past which it never looks. Throws Divergence (divergence.hpp) as soon as a loss, a Q value or a weight
  // is not finite: after an episode that it returned, all weights are.
  template <Environment E>
  EpisodeRow play(E& env, int episode);

  // What is learnt so far: the network that the model will hold.
  [[nodiscard]] Parameters result() const;

  // Before the first episode: begins from these weights, of the setup's shape, instead of random ones.
  void begin_from(const Parameters& parameters);

  // Between two episodes: all that goes on. `resume` takes the state of a learner of the same setup.
  [[nodiscard]] const LearnerState& state() const { return state_; }
  void resume(LearnerState state);

  // For benchmarks: a gradient step by itself.
  void remember(const Features& features, int action, double reward, const Features& next, bool end,
                bool truncated = false);
  void learn(EpisodeRow& row);

 private:
  EpisodeRow begin_episode(int episode);
  int choose(const Features& features, double epsilon);
  [[nodiscard]] bool warm() const;
  void sample();
  double differentiate(EpisodeRow& row);
  [[nodiscard]] float value_of_next(Eigen::Index i) const;
  void weigh_samples();
  void update_priorities();
  void require_finite(bool finite, const char* what, int episode) const;
  void require_finite_weights(int episode) const;
  void follow();
  void round_online();
  // The online network as it plays and is differentiated.
  [[nodiscard]] const Parameters& played() const { return config_.int8_weights ? rounded_ : state_.online; }

  LearnerConfig config_;
  OptimiserConfig optimiser_;
  ExplorationConfig exploration_;
  int planned_episodes_;
  MirrorImage mirror_;

  LearnerState state_;
  Parameters rounded_;
  NStep n_step_;            // empty between two episodes
  bool exploring_ = false;  // the last choice was random
  double progress_ = 0.0;   // of the training, 0 to 1

  // The room of a gradient step: a sample a column.
  std::vector<Eigen::Index> places_;
  std::vector<int> actions_;
  Eigen::MatrixXf sampled_, sampled_next_, q_gradient_;
  Eigen::VectorXf td_errors_, sample_weights_;
  Pass pass_, next_pass_, choosing_pass_;
  Eigen::VectorXf gradient_;
  Actor actor_;
  Features features_, next_features_;
};

// The weights that a training begins with: uniform, He et al. 2015; biases 0.
[[nodiscard]] Parameters initial_parameters(const Shape& shape, std::uint64_t seed);

template <Environment E>
EpisodeRow Learner::play(E& env, int episode) {
  EpisodeRow row = begin_episode(episode);
  const std::int64_t steps_before = state_.gradient_steps;
  features_ = env.features();
  for (bool end = false; !end; ++row.decisions) {
    const int action = choose(features_, row.epsilon);
    const StepResult result = env.step(action);
    end = result.end;
    next_features_ = env.features();
    remember(features_, action, result.reward, next_features_, end, result.truncated);
    features_.swap(next_features_);
    for (int i = 0; warm() && i < config_.gradient_steps; ++i) {
      learn(row);
    }
  }
  require_finite_weights(episode);
  row.reward = env.outcome().reward;
  row.success = env.success();
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, state_.gradient_steps - steps_before));
  row.loss /= steps;
  row.td_error /= steps;
  row.q /= steps;
  return row;
}

}  // namespace striker::training

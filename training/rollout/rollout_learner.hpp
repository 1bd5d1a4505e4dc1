// SPDX-License-Identifier: Apache-2.0
// The learner from own rollouts: `learner.kind = "rollout"`. Where DQN estimates what an action is worth from what was
// paid for it and its own estimate of the rest, this one plays the rest: rollouts.hpp. It takes an environment that can be
// branched anywhere, and so the task on a line only; there it is better by what the estimates lose.
//
//   RolloutLearner learner(setup, tasks, seed);
//   std::vector<EpisodeRow> rows = learner.play_round(0, 256);
//
// Its outputs are preferences with the value of the state put back (preference_loss.hpp): the greatest of them is what
// greedy play gets from here on, the others lie below it by how clear the choice is.
#pragma once

#include <cstdint>
#include <vector>

#include "training/learner/dqn.hpp"
#include "training/rollout/preference_loss.hpp"
#include "training/rollout/rollouts.hpp"

namespace striker::training {

// Between two rounds: all that goes on.
struct RolloutState {
  Parameters online;
  Parameters average;  // of the online network's weights: it plays
  Adam adam;
  LabelStore labels;
  sil::Random exploring;
  sil::Random sampling;
  std::int64_t decisions = 0;
  std::int64_t gradient_steps = 0;
};

class RolloutLearner {
 public:
  RolloutLearner(const LearnerSetup& setup, const std::vector<TaskConfig>& tasks, std::uint64_t seed);

  // Plays training episodes `first` to `first + count - 1` and learns from them; a row an episode, whose figures of
  // learning are the round's. Throws Divergence as Learner::play does.
  std::vector<EpisodeRow> play_round(int first, int count);

  [[nodiscard]] Parameters result() const;
  void begin_from(const Parameters& parameters);
  [[nodiscard]] const RolloutState& state() const { return state_; }
  void resume(RolloutState state) { state_ = std::move(state); }

 private:
  [[nodiscard]] bool due() const;
  [[nodiscard]] PreferenceLoss loss_at(double progress) const;
  void learn(const PreferenceLoss& loss, EpisodeRow& figures);
  void sample();
  float differentiate(const PreferenceLoss& loss, EpisodeRow& figures);
  void require_finite(bool finite, const char* what, int episode) const;

  LearnerSetup setup_;
  std::uint64_t seed_;
  RolloutState state_;
  Rollouts rollouts_;

  // The room of a gradient step: a sample a column.
  std::vector<Eigen::Index> places_;
  Eigen::MatrixXf sampled_, q_gradient_;
  Pass pass_;
  Eigen::VectorXf gradient_;
};

}  // namespace striker::training

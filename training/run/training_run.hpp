// SPDX-License-Identifier: Apache-2.0
// A training from its first episode to its last, in memory. directory/train_into.hpp keeps it in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "training/model/model.hpp"
#include "training/run/checkpoint/checkpoint.hpp"
#include "training/run/config.hpp"
#include "training/run/learners.hpp"
#include "training/task/environments.hpp"

namespace striker::training {

// The moving average that the paper draws, in episodes.
inline constexpr int moving_average_span = 250;

// A row of the learning curve.
struct CurveRow {
  EpisodeRow episode;
  double moving_average = 0.0;  // of the reward, over the last 250 episodes or all so far
};

// One round after another: an episode with DQN, `rollout.round` of them with the learner from own rollouts. A pure
// function of the configuration and the seed, on one type of machine.
class Training {
 public:
  Training(const Config& config, std::uint64_t seed);

  // Throws Divergence (learner/divergence.hpp), after which only `state` and what was kept before are sound.
  // The rows of its episodes, until the next call.
  std::span<const CurveRow> play_round();
  [[nodiscard]] bool done() const { return state_.episodes == config_.run.episodes; }

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  [[nodiscard]] Parameters result() const { return result_of(learner_); }  // the network so far
  [[nodiscard]] std::int64_t decisions() const;
  [[nodiscard]] std::int64_t gradient_steps() const;
  [[nodiscard]] int episodes() const { return state_.episodes; }
  [[nodiscard]] const RunState& state() const { return state_; }
  // Before the first episode: begins from this network (require_fits in model_task.hpp), and notes it.
  void begin_from(const Parameters& parameters);
  void note_best(double mean, const Parameters& parameters);

  void save(const std::filesystem::path& checkpoint) const;
  void resume(const std::filesystem::path& checkpoint);

 private:
  EpisodeRow play_episode(Learner& learner);
  void add_row(const EpisodeRow& episode);

  Config config_;
  std::uint64_t seed_;
  std::vector<AnyEnvironment> environments_;
  AnyLearner learner_;
  RunState state_;
  std::vector<CurveRow> rows_;  // of the last round
};

// The model of a training so far, with its metadata but for the mean reward; and the best one of its greedy
// evaluations, of which there must have been one.
[[nodiscard]] Model model_of(const Training& training);
[[nodiscard]] Model best_model_of(const Training& training);

// The mean greedy reward on the run's validation episodes, which neither training nor evaluation meets.
[[nodiscard]] double validation_mean(const Training& training, const Parameters& parameters);

}  // namespace striker::training

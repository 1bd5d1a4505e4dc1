// SPDX-License-Identifier: Apache-2.0
// A training from its first episode to its last: in memory, and as a directory that it can be resumed from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "training/learner/dqn.hpp"
#include "training/model/model.hpp"
#include "training/run/checkpoint.hpp"
#include "training/run/config.hpp"
#include "training/task/environments.hpp"

namespace striker::training {

// The moving average that the paper draws, in episodes.
inline constexpr int moving_average_span = 250;

// A row of the learning curve.
struct CurveRow {
  EpisodeRow episode;
  double moving_average = 0.0;  // of the reward, over the last 250 episodes or all so far
};

// One episode after another. A pure function of the configuration and the seed, on one type of machine.
class Training {
 public:
  Training(const Config& config, std::uint64_t seed);

  CurveRow play_episode();
  [[nodiscard]] bool done() const { return state_.episodes == config_.run.episodes; }

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  [[nodiscard]] const Learner& learner() const { return learner_; }
  [[nodiscard]] int episodes() const { return state_.episodes; }
  [[nodiscard]] const RunState& state() const { return state_; }
  void note_best(double mean, const Parameters& parameters);

  void save(const std::filesystem::path& checkpoint) const;
  void resume(const std::filesystem::path& checkpoint);

 private:
  Config config_;
  std::uint64_t seed_;
  std::vector<AnyEnvironment> environments_;
  Learner learner_;
  RunState state_;
};

// The model of a training so far, with its metadata but for the mean reward; and the best one of its greedy
// evaluations, of which there must have been one.
[[nodiscard]] Model model_of(const Training& training);
[[nodiscard]] Model best_model_of(const Training& training);

struct TrainingResult {
  bool interrupted = false;
  int episodes = 0;
  std::int64_t decisions = 0;
  std::int64_t gradient_steps = 0;
  double moving_average = 0.0;
  std::optional<double> mean_reward;  // of the model, on the validation episodes, if it was measured
  std::optional<double> best_mean_reward;
};

// Called after each episode; false ends the training there.
using TrainingProgress = std::function<bool(const CurveRow&)>;

// Trains into a directory, which is made if it is missing:
//   model.safetensors      the network at the end
//   best.safetensors       the best one of the greedy evaluations, if the configuration wants any
//   learning_curve.csv     a row an episode
//   evaluations.csv        a row a greedy evaluation
//   speed.csv              measured by the clock: the only file that differs between equal runs
//   checkpoint.safetensors while the run is not complete
// An interrupted one keeps all of it, and `resume` goes on to the same bytes as if it had not stopped.
// Throws std::runtime_error with one line: an unfinished run is there and `resume` is not set, or `resume` is
// and there is nothing to go on from, or a file is damaged or cannot be written.
TrainingResult train_into(const std::filesystem::path& directory, const Config& config, std::uint64_t seed,
                          bool resume, const TrainingProgress& progress);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// A whole training into a directory that it can be resumed from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>

#include "training/run/directory/run_directory.hpp"

namespace striker::training {

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

// The training left the finite numbers. The text is one line with episode and gradient step, the files that are
// sound, and the way out.
class TrainingDiverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Trains into a directory, which is made if it is missing:
//   model.safetensors      the network at the end
//   best.safetensors       the best one of the greedy evaluations, if the configuration wants any
//   learning_curve.csv     a row an episode
//   evaluations.csv        a row a greedy evaluation
//   speed.csv              measured by the clock: the only file that differs between equal runs
//   checkpoint.safetensors what a later training goes on from; about 4 (2 inputs + 3) bytes a transition held
// An interrupted one keeps all of it, and resuming goes on to the same bytes as if it had not stopped.
// Throws TrainingDiverged, after which no file of the diverged network is there; and std::runtime_error with one
// line: the directory's files do not fit `start` (run_directory.hpp), or a file is damaged or cannot be written.
// `initial` is the network that a training begins from (of the configuration's shape; not with Start::resume).
TrainingResult train_into(const std::filesystem::path& directory, const Config& config, std::uint64_t seed,
                          Start start, const TrainingProgress& progress, const Parameters* initial = nullptr);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// A training run at the end of an episode, as a file: to resume from, to the same bits.
//
// It is safetensors like a model: the networks, Adam's moments and the replay buffer or the labels as tensors; counters,
// generators and the rest of the run's state as text. Numbers in text are hexadecimal floats, exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "training/run/config.hpp"
#include "training/run/learners.hpp"

namespace striker::training {

// What a run knows beside its learner.
struct RunState {
  int episodes = 0;                    // played
  std::vector<double> recent_rewards;  // of the last 250 episodes or all, the oldest first
  // The best network of the greedy evaluations, without its dueling head; none before the first evaluation.
  int best_episodes = 0;
  double best_mean = 0.0;
  Eigen::VectorXf best_values;
  // What configuration and seed do not tell, a clause each: the network that it began from, keys that changed when it
  // was resumed. Empty: a pure function of configuration and seed.
  std::string history;
};

void save_checkpoint(const std::filesystem::path& file, const Config& config, std::uint64_t seed,
                     const AnyLearner& learner, const RunState& run);

// Throws std::runtime_error, naming the file, for one that is damaged, of another seed, or of a configuration
// that differs in a key that may not change (config_changes.hpp). What did change is noted in the history.
RunState load_checkpoint(const std::filesystem::path& file, const Config& config, std::uint64_t seed,
                         AnyLearner& learner);

}  // namespace striker::training

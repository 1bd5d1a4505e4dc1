// A training run's configuration: one TOML file, in which every field must stand. What each one means is
// said where it is set, in training/configs/paper.toml.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kick_env.hpp"

namespace striker::training {

struct LearnerConfig {
  double gamma = 0.95;
  int n_step = 1;
  bool double_dqn = false;
  bool huber = false;
  bool mirror = false;
  int batch = 64;
  int replay_size = 200'000;
  int warm_up = 1'000;        // decisions
  int target_period = 1'000;  // gradient steps
  int gradient_steps = 1;     // a decision
};

struct OptimiserConfig {
  double learning_rate = 1e-3;
  double final_fraction = 1.0;  // of the learning rate, reached at the last episode
};

struct ExplorationConfig {
  double epsilon_start = 1.0;
  double epsilon_end = 0.05;
  int decay_episodes = 1'000;
};

struct Config {
  std::string name;  // the file's name without its extension
  std::string text;  // the file as it was read
  int episodes = 5'000;
  int validation_episodes = 1'000;
  std::vector<EnvConfig> environments;  // played in turn, episode by episode; the first one validates
  LearnerConfig learner;
  OptimiserConfig optimiser;
  ExplorationConfig exploration;
};

// Throws std::runtime_error with a one-line message that names the file, the key, the value and the range.
[[nodiscard]] Config load_config(const std::filesystem::path& file);
[[nodiscard]] Config parse_config(std::string_view text, const std::string& file);

}  // namespace striker::training

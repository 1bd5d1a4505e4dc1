// A training run's configuration, from a TOML file. What each key means is said in
// training/configs/paper.toml, which also holds every default.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "training/learner/network.hpp"
#include "training/task/kick_environment.hpp"

namespace striker::training {

// How a number goes from its first value to its last one.
enum class Course { linear, cosine, exponential };

struct RunConfig {
  int episodes = 0;
  int evaluation_period = 0;
  int validation_episodes = 0;
  int checkpoint_period = 0;
};

struct LearnerConfig {
  double gamma = 0.0;
  int n_step = 0;
  bool cut_at_exploration = false;
  bool double_dqn = false;
  bool huber = false;
  bool mirror = false;
  int batch = 0;
  int replay_size = 0;
  int warm_up = 0;        // decisions
  int target_period = 0;  // gradient steps
  double target_rate = 0.0;
  int gradient_steps = 0;  // a decision
  double clip_norm = 0.0;
  bool int8_weights = false;
  bool prioritised = false;
  double priority_exponent = 0.0;
  double priority_correction = 0.0;
};

struct OptimiserConfig {
  double learning_rate = 0.0;
  double final_fraction = 0.0;
  Course schedule = Course::linear;
  double averaging = 0.0;
};

struct ExplorationConfig {
  double epsilon_start = 0.0;
  double epsilon_end = 0.0;
  int decay_episodes = 0;
  Course schedule = Course::linear;
};

struct Config {
  std::string name;  // the file's name without its extension
  std::string text;  // every key with its value, in one fixed order: the same text is the same training
  RunConfig run;
  std::vector<EnvConfig> environments;  // played in turn, episode by episode; the first one validates
  Shape shape;
  LearnerConfig learner;
  OptimiserConfig optimiser;
  ExplorationConfig exploration;
};

// The defaults: training/configs/paper.toml as it was built in.
[[nodiscard]] std::string_view default_configuration();

// Both throw std::runtime_error with a one-line message that names the file, the key, the value and the
// range. `changes` are lines of "table.key = value" that override the file.
[[nodiscard]] Config load_config(const std::filesystem::path& file,
                                 const std::vector<std::string>& changes = {});
[[nodiscard]] Config parse_config(std::string_view text, const std::string& file,
                                  const std::vector<std::string>& changes = {});

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// A training run's configuration, from a TOML file. What each key means is said in
// training/configs/paper.toml, which also holds every default.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "training/learner/learner_config.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

struct RunConfig {
  int episodes = 0;
  int evaluation_period = 0;    // episodes between two greedy evaluations; 0: none
  int validation_episodes = 0;  // how many an evaluation plays
  int checkpoint_period = 0;    // episodes; 0: only when interrupted
};

struct Config {
  std::string name;  // the file's name without its extension
  // Every key with its value, in one fixed order: the same text is the same training. `task.kind` stands in
  // it only if it is not "kick", [robot] only if it is not the forward, `learner.time_limit` only if it is true,
  // `learner.kind`, [rollout] and [randomise] only if the learner is not "dqn": configurations are known by their text's
  // hash, and older ones did not have those keys.
  std::string text;
  RunConfig run;
  std::vector<TaskConfig> environments;  // played in turn, episode by episode; the first one validates
  Shape shape;
  LearnerConfig learner;
  RolloutConfig rollout = {};
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

// The changes that make it another robot's: "robot.body_mass_g=2500" and so on.
[[nodiscard]] std::vector<std::string> robot_changes(const core::RobotDescription& robot);

// The learner that it describes.
[[nodiscard]] LearnerSetup setup_of(const Config& config);

}  // namespace striker::training

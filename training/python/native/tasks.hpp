// SPDX-License-Identifier: Apache-2.0
// What an environment in Python is asked to play: the tasks of a training configuration, as striker-train reads it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "training/task/task_config.hpp"

namespace striker::training {

struct Tasks {
  // Equal but for their velocities; episode k is played in environments[k % size], as in a training.
  std::vector<TaskConfig> environments;
  std::string text;  // the whole configuration, every key
};

// From a file, or from `text` where there is none, with `changes` ("task.world=\"full\"") after it; `robot` is the file
// of a robot's description. Throws std::runtime_error with one line that names key, value and what is allowed.
[[nodiscard]] Tasks tasks_of(const std::optional<std::filesystem::path>& config, const std::string& text,
                             const std::optional<std::filesystem::path>& robot,
                             const std::vector<std::string>& changes);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// The task that a model was trained for.
#pragma once

#include <filesystem>
#include <string>

#include "training/model/model.hpp"
#include "training/run/config.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// From the configuration that the model holds. `config_file` tells it of a model that holds none; without
// either it is the official task with the RCS state. Throws std::runtime_error, which names the model's `file`, if inputs or
// actions do not fit the network.
[[nodiscard]] TaskConfig task_of(const Model& model, const std::filesystem::path& file,
                                 const std::filesystem::path& config_file);

// The same task for another robot. Throws std::runtime_error if its wheels do not reach what an action sets them to.
[[nodiscard]] TaskConfig with_robot(TaskConfig task, const core::RobotDescription& robot);

// Throws std::runtime_error, naming `file`, what differs and the way out, unless a training of `config` can begin
// from this model: its network's widths, and (where the model says so) its task's inputs, actions and mirror.
void require_fits(const Model& model, const Config& config, const std::string& file);

}  // namespace striker::training

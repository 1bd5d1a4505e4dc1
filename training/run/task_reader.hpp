// SPDX-License-Identifier: Apache-2.0
// The tables of a configuration that describe the task: [task], [robot], and those of its kind ([ball] and [reward]
// for the kick).
#pragma once

#include <string>
#include <vector>

#include "training/run/toml_reader.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// [robot], whose keys and ranges are those of a description's file (firmware/core/robot_ranges.hpp).
[[nodiscard]] core::RobotDescription read_robot_table(const TomlReader& reader);

// One for each kind of velocities that `task.velocities` asks for, equal in everything else.
[[nodiscard]] std::vector<TaskConfig> read_environments(const TomlReader& reader);

// Mirror images are asked for in one way or both: then inputs and actions must have one.
void require_mirror_images(const TomlReader& reader, const TaskConfig& task, bool augment_mirrored);

}  // namespace striker::training

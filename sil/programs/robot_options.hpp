// SPDX-License-Identifier: Apache-2.0
// `--robot FILE`: the robot that a controller in this process is told of. `--vary NAME=VALUE,...`: what it is in truth.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "firmware/core/robot_profile.hpp"

namespace striker::sil {

// Adds the option. On a bus it means nothing: a controller there was told when it was built.
void define_robot(CLI::App& command, std::string& file);

void define_variation(CLI::App& command, std::string& vary);

// Refuses --robot with --bus can:IFACE; for the command's final callback.
void require_robot_in_process(CLI::App& command, const std::string& bus);

// Whether a policy's actions are within what a robot can.
using Suits = bool (*)(const core::RobotProfile&);

// The description in `file`, or the built-in one where it is empty. Throws std::runtime_error where the file is none, or
// where the policy (the built-in one, if no other is said) asks for more than the robot can.
[[nodiscard]] core::RobotDescription described_robot(const std::string& file, Suits suits = nullptr);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What the firmware can serve. It checks all of it again: this says so before the header is written, in
// words.
#pragma once

#include "training/task/task_config.hpp"

namespace striker::training {

// Throws std::runtime_error with one line, which names the key and the way out, for a task whose policy no
// controller could run: the printed equations, elements that it does not know, more inputs than it has room
// for, or a set-point beyond the robot's top speed.
void require_firmware_serves(const TaskConfig& task);

}  // namespace striker::training

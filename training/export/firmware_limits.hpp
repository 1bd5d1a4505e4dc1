// SPDX-License-Identifier: Apache-2.0
// What the firmware can serve. It checks all of it again: this says so before the header is written, in
// words.
#pragma once

#include "training/learner/network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// Throws std::runtime_error with one line, which names the key and the way out, for a task whose policy no
// controller could run: the printed equations, elements that it does not know, more inputs than it has room
// for, or a set-point beyond the robot's top speed.
void require_firmware_serves(const TaskConfig& task);

// GCC 12 packs and proves 163,600 (6-400-400-3, int16 and int8, for the Cortex-M0+, M4, M55 and x86-64) within its own limit of
// operations in a constant (-fconstexpr-ops-limit, 33,554,432), and not 496,300. 320 KB of flash as int16.
inline constexpr std::size_t most_weights = 160'000;

// Throws likewise for a network that no compiler would make a header of, but only after minutes, and without saying why.
void require_header_compiles(const Shape& shape);

}  // namespace striker::training

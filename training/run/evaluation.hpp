// SPDX-License-Identifier: Apache-2.0
// What a network is worth: greedy play.
#pragma once

#include <cstdint>

#include "training/learner/network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// The mean reward of greedy play on `count` (at least 1) episodes of a seed, numbered from `first_episode` on
// (episode_numbers.hpp).
[[nodiscard]] double mean_reward(const TaskConfig& task, const Parameters& parameters, std::uint64_t seed,
                                 std::uint64_t first_episode, int count);

}  // namespace striker::training

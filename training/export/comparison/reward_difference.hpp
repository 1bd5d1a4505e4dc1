// SPDX-License-Identifier: Apache-2.0
// What the integer network loses in reward against the float one, in the simulator's world.
#pragma once

#include <functional>

#include "training/export/integer_network.hpp"
#include "training/learner/network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// Of the episodes, from first_reward_difference_episode on.
inline constexpr std::uint64_t reward_difference_seed = 1;

// Called after each episode, for progress.
using EpisodePlayed = std::function<void()>;

struct RewardDifference {
  int episodes = 0;
  double float_mean = 0.0;
  double integer_mean = 0.0;
  double standard_error = 0.0;  // of the mean difference, over paired episodes; s with n, not n - 1
};

// Both play the same episodes greedily among wheel bodies, on velocities as the firmware estimates them.
[[nodiscard]] RewardDifference reward_difference(
    const Parameters& parameters, const IntegerNetwork& network, TaskConfig task, int episodes,
    const EpisodePlayed& done = [] {});

}  // namespace striker::training

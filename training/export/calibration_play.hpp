// SPDX-License-Identifier: Apache-2.0
// States that a policy meets in play: what the quantiser's scales are made for, and what it is judged on.
#pragma once

#include <vector>

#include "training/export/comparison/reward_difference.hpp"
#include "training/learner/network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// The states before the contact of `count` episodes each of greedy and of random play, among wheel bodies.
// `first` numbers the episodes, which neither training nor evaluation meets (episode_numbers.hpp): different
// numbers, other states.
[[nodiscard]] std::vector<RawState> calibration_play(
    const Parameters& parameters, TaskConfig task, int first, int count, const EpisodePlayed& played = [] {});

}  // namespace striker::training

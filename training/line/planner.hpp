// SPDX-License-Identifier: Apache-2.0
// What the best simple plan gets from a situation: backward for some decisions, wait for some, then forward to the
// end. It is line_play.hpp's planner for a task of one's own (its actions, its rewards), with what is known
// about an episode instead of what is seen of it. It teaches a network before its own play is worth anything.
#pragma once

#include "training/line/line_episode.hpp"

namespace striker::training {

// The reward of the whole episode, of a robot that is not over. About 10 us.
[[nodiscard]] double plan_reward(const LineKick& kick, const LineEpisode& episode, const LineRobot& robot);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// What each robot of the team `striker` does in open play: the goalkeeper guards, the chaser drives the ball into the
// goal, the others stand where a ball that is lost or cleared comes to. The guard arc and the zones are those of the public
// players of 2021 (AI Soccer 3D); sizes were found by playing against `rules`.
#pragma once

#include <cstddef>

#include "sil/match/team/order.hpp"
#include "sil/match/team/striker/situation.hpp"

namespace striker::sil {

[[nodiscard]] SpeedOrder keep_goal(const Situation& now);
[[nodiscard]] SpeedOrder chase_ball(const Situation& now, std::size_t id);

// Where somebody who does neither stands.
[[nodiscard]] Vec2 post_of(const Situation& now, std::size_t id);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Who gets the ball when play stops (AI World Cup test_world 37312a93). Everything is in red's frame. "Defenders" are
// the team at whose end it happens: red's is x < 0, and the middle line counts as blue's. In doubt the attackers get
// it.
#pragma once

#include <array>

#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

[[nodiscard]] constexpr Team defenders_at(Vec2 ball) {
  return ball.x < 0.0 ? Team::red : Team::blue;
}

// Of both teams: red's, blue's.
struct Count {
  std::array<int, 2> robots = {};
  std::array<double, 2> distances_m = {};  // to the ball, summed

  [[nodiscard]] int of(Team team) const { return robots[index_of(team)]; }
};

// Who touched the ball in the last frame in which anybody did: they may be of both teams.
[[nodiscard]] Count count_touches(RobotSet last_touch);

// Of the robots in `active`: those in the penalty strip at the ball's end, those in the ball's corner.
[[nodiscard]] Count count_in_penalty_strip(const RefereeFrame& frame, RobotSet active);
[[nodiscard]] Count count_in_corner(const RefereeFrame& frame, RobotSet active);

// After an out: the team that touched less, not the one that touched more.
[[nodiscard]] Team owner_after_out(const Count& touches, Team defenders);

// After a deadlock: who has more robots there; else who is nearer in sum.
[[nodiscard]] Team owner_after_deadlock(const Count& there, Team defenders);

// Whether the last to touch the ball were of this team alone.
[[nodiscard]] bool touched_alone(Team team, RobotSet last_touch);

}  // namespace striker::sil

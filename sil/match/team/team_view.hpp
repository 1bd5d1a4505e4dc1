// SPDX-License-Identifier: Apache-2.0
// What a team is shown of a match, every 50 ms while the clock runs: what a player of AI Soccer sees, no velocities.
//
// Own-team frame: x to the opponent's goal, y to the left of it, origin in the centre, metres, headings anticlockwise
// from +x in (-pi, pi]. It turns at half-time, so that a team never knows of sides.
#pragma once

#include <array>
#include <cstdint>

#include "sil/match/referee/event.hpp"
#include "sil/match/referee/referee_frame.hpp"
#include "sil/match/referee/ruling.hpp"

namespace striker::sil {

struct RobotView {
  Pose pose;
  bool active = true;     // neither locked by a set piece nor sent out
  bool touching = false;  // touched the ball since the last frame
};

struct TeamView {
  int clock_ms = 0;  // of the half
  int half = 1;
  std::int64_t sim_ms = 0;        // simulated time of what is seen, since the match began
  std::array<int, 2> score = {};  // own, the opponent's
  // The end of a half, shown in its pause, counts as open play: so AI Soccer's messages have it.
  GameState state = GameState::kickoff;
  bool has_ball = false;                         // in a set piece alone: it is this team's
  ResetReason reset_reason = ResetReason::none;  // red is whoever plays in red, in either half
  std::array<RobotView, robots_a_team> own;
  std::array<RobotView, robots_a_team> opponents;
  Vec2 ball_m;
  double ball_height_m = 0.05;  // of its centre
};

// `team` as it sees a frame. `ruling` is that of the frame before (referee.hpp).
[[nodiscard]] TeamView view_of(Team team, const RefereeFrame& seen, const Ruling& ruling);

}  // namespace striker::sil

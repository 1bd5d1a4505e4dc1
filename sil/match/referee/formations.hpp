// SPDX-License-Identifier: Apache-2.0
// Where everybody stands when play begins: AI Soccer's formations (AI World Cup test_world 37312a93), to the digit.
// Somebody who wants them a little apart each time moves the bodies, not this table.
#pragma once

#include <array>

#include "sil/match/referee/event.hpp"

namespace striker::sil {

// Of a team in its own frame. In a corner kick "low" and "high" say whether the ball is at y < 0 or y > 0 there, and
// "theirs" and "ours" whose end it is at.
enum class Formation : std::uint8_t {
  home,
  kickoff,    // of who kicks off; the others are at home
  goal_kick,  // of the kicking team
  against_goal_kick,
  corner_theirs_low,  // of the kicking team, at the opponent's end
  corner_theirs_high,
  against_corner_high,  // against a corner kick at the own end
  against_corner_low,
  corner_ours_high,  // of the kicking team, at its own end
  corner_ours_low,
  against_corner_far,  // against a corner kick at the opponent's end
  penalty,
  against_penalty,
};

using TeamSpots = std::array<Pose, robots_a_team>;  // in the team's own frame

[[nodiscard]] const TeamSpots& spots_of(Formation formation);

// In the team's own frame. A home spot is the one of Formation::home; a slot lies inside the block beside the goal.
[[nodiscard]] Pose home_spot(std::size_t id);
[[nodiscard]] Pose slot(std::size_t id);

inline constexpr double placed_ball_height_m = 0.06;
inline constexpr double dropped_ball_height_m = 0.2;

// Of both teams, in red's frame.
struct LineUp {
  std::array<Pose, robots_in_match> robots;
  Vec2 ball;
};

// `set_piece` is one. `stopped_ball`, in red's frame, says in which corner a corner kick is: x = 0 counts as blue's
// end, y = 0 as y < 0.
[[nodiscard]] LineUp line_up_of(GameState set_piece, Team owner, Vec2 stopped_ball);

// In red's frame: where a ball is dropped after a deadlock. x and y as above.
[[nodiscard]] Vec2 drop_spot(Vec2 stopped_ball);

// Who alone may play the ball.
[[nodiscard]] std::size_t kicker_of(GameState set_piece, Team owner);

}  // namespace striker::sil

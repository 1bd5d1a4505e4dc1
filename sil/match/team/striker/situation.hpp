// SPDX-License-Identifier: Apache-2.0
// What the roles of the team `striker` decide by, in one frame.
#pragma once

#include <array>
#include <cstddef>

#include "sil/match/team/striker/ball_track.hpp"
#include "sil/match/team/team_view.hpp"

namespace striker::sil {

// Where and when a robot can have the ball.
struct Interception {
  Vec2 ball;
  double time_s = 0.0;
};

inline constexpr std::size_t nobody = robots_a_team;  // in an id's place

struct Situation {
  const TeamView& view;
  const BallTrack& ball;
  std::array<Interception, robots_a_team> interceptions = {};
  std::size_t chaser = nobody;  // the only one that goes for the ball, beside a goalkeeper in its area
};

// A view with nothing in it that is no number or far from the field: that is taken to be in the centre.
[[nodiscard]] TeamView made_sane(TeamView view);

[[nodiscard]] std::array<Interception, robots_a_team> interceptions_of(const TeamView& view,
                                                                       const BallTrack& ball);

// Who has the ball first, of robots 1 to 4. Defenders stay back and forwards ahead, if others are about as
// near; and who was the chaser before is so again, if as near.
[[nodiscard]] std::size_t chaser_of(const std::array<Interception, robots_a_team>& interceptions, Vec2 ball,
                                    std::size_t before);

}  // namespace striker::sil

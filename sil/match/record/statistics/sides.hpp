// SPDX-License-Identifier: Apache-2.0
// Which way a team plays, for who watches from beside the field.
#pragma once

#include <optional>

#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

// Red does in the first half, blue in the second.
[[nodiscard]] constexpr bool plays_towards_plus_x(Team team, int half) {
  return (team == Team::red) == (half == 1);
}

// A place of the field frame in the team's own: x to the opponent's goal.
[[nodiscard]] constexpr Vec2 own_spot(Team team, int half, Vec2 spot) {
  return plays_towards_plus_x(team, half) ? spot : turned(spot);
}

// The team that all of these robots are of, if they are of one.
[[nodiscard]] inline std::optional<Team> only_team_of(RobotSet robots) {
  const bool has_red = (robots & robots_of(Team::red)).any();
  const bool has_blue = (robots & robots_of(Team::blue)).any();
  if (has_red == has_blue) {
    return {};
  }
  return has_red ? Team::red : Team::blue;
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/referee/ownership.hpp"

#include <cmath>

#include "sil/match/referee/areas.hpp"

namespace striker::sil {
namespace {

// `is_there` judges a robot in the defenders' frame.
template <typename Test>
Count count_where(const RefereeFrame& frame, RobotSet active, Test is_there) {
  const Team defenders = defenders_at(frame.ball.position_m);
  Count count;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const Vec2 spot = {frame.robots[robot].x_m, frame.robots[robot].y_m};
    if (!active[robot] || !is_there(defenders == Team::red ? spot : turned(spot))) {
      continue;
    }
    const double x_m = spot.x - frame.ball.position_m.x;
    const double y_m = spot.y - frame.ball.position_m.y;
    const std::size_t team = index_of(team_of(robot));
    ++count.robots[team];
    count.distances_m[team] += std::sqrt(x_m * x_m + y_m * y_m);
  }
  return count;
}

}  // namespace

Count count_touches(RobotSet last_touch) {
  Count count;
  for (const Team team : teams) {
    count.robots[index_of(team)] = static_cast<int>((last_touch & robots_of(team)).count());
  }
  return count;
}

Count count_in_penalty_strip(const RefereeFrame& frame, RobotSet active) {
  return count_where(frame, active, in_own_penalty_strip);
}

Count count_in_corner(const RefereeFrame& frame, RobotSet active) {
  // In the defenders' frame, as the robots.
  const Vec2 ball = frame.ball.position_m;
  const double y_m = defenders_at(ball) == Team::red ? ball.y : -ball.y;
  return count_where(frame, active, [y_m](Vec2 robot) { return in_own_corner(robot, y_m); });
}

Team owner_after_out(const Count& touches, Team defenders) {
  if (touches.robots[0] == touches.robots[1]) {
    return opponent_of(defenders);
  }
  return touches.robots[0] > touches.robots[1] ? Team::blue : Team::red;
}

Team owner_after_deadlock(const Count& there, Team defenders) {
  if (there.robots[0] != there.robots[1]) {
    return there.robots[0] > there.robots[1] ? Team::red : Team::blue;
  }
  if (there.distances_m[0] < there.distances_m[1]) {
    return Team::red;
  }
  return there.distances_m[1] < there.distances_m[0] ? Team::blue : opponent_of(defenders);
}

bool touched_alone(Team team, RobotSet last_touch) {
  return last_touch.any() && (last_touch & ~robots_of(team)).none();
}

}  // namespace striker::sil

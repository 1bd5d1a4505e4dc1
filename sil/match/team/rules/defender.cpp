// SPDX-License-Identifier: Apache-2.0
// The nearer one pushes the ball away or goes round behind it, the other one covers the goal.
#include <algorithm>
#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

constexpr double waiting_x_m = -0.7 * field_half_length_m;              // -2.73
constexpr double shooting_x_m = 0.3 * field_half_length_m;              // 1.17
constexpr double last_x_m = -field_half_length_m + robot_side_m / 2.0;  // -3.825
constexpr double last_cover_x_m = last_x_m + 0.1;                       // -3.725
constexpr double cover_y_m = goal_half_width_m + 0.15;                  // 0.65
constexpr double most_y_m = field_half_width_m - robot_side_m / 2.0;    // 2.25

constexpr GoToGains driving = {1.4, 5.0, 0.4, true};
constexpr GoToGains turning = {1.4, 3.5, 0.6, false};
constexpr GoToGains placing = {1.4, 3.5, 0.4, false};

Action nearest(Vec2 robot, Vec2 ball) {
  if (has_shoot_chance(robot, ball) && ball.x < shooting_x_m) {
    return GoTo{ball, driving};
  }
  if (!(ball.x < 0.0)) {
    return GoTo{{waiting_x_m, ball.y}, placing};
  }
  if (robot.x < ball.x - told_ball_radius_m) {
    return GoTo{ball, driving};
  }
  const double y_m = std::abs(ball.y - robot.y) > 0.3 ? ball.y : robot.y;
  return GoTo{{std::max(ball.x - 0.5, last_x_m), y_m}, turning};
}

Action other(Vec2 ball) {
  if (ball.x < 0.0) {
    return GoTo{{std::max(ball.x - 0.5, last_cover_x_m), std::clamp(ball.y, -cover_y_m, cover_y_m)}, placing};
  }
  const double y_m = ball.y < 0.0 ? std::min(ball.y + 0.5, most_y_m) : std::max(ball.y - 0.5, -most_y_m);
  return GoTo{{waiting_x_m, y_m}, placing};
}

}  // namespace

Action defender_action(Vec2 robot, Vec2 ball, bool is_nearest) {
  if (robot.x < -field_half_length_m) {
    return GoTo{{waiting_x_m, robot.y < 0.0 ? robot.y + 0.2 : robot.y - 0.2}, turning};  // out of the goal
  }
  return is_nearest ? nearest(robot, ball) : other(ball);
}

}  // namespace striker::sil

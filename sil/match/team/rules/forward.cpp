// SPDX-License-Identifier: Apache-2.0
// The nearer one drives the ball ahead, the other one waits aside of it.
#include <algorithm>
#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "sil/match/team/top_speed.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

constexpr double zone_x_m = 0.3 * field_half_length_m;                // 1.17
constexpr double waiting_x_m = -0.1 * field_half_length_m;            // -0.39
constexpr double most_y_m = field_half_width_m - robot_side_m / 2.0;  // 2.25

constexpr GoToGains driving = {1.4, 5.0, 0.4, true};
constexpr GoToGains leaving = {1.4, 3.0, 0.8, false};
constexpr GoToGains turning = {1.4, 3.5, 0.6, false};
constexpr GoToGains placing = {1.4, 3.5, 0.4, false};

bool is_in_the_way(Vec2 robot, Vec2 ball) {
  return std::abs(ball.x) < zone_x_m && robot.x > ball.x + 0.1 && std::abs(robot.y - ball.y) < 0.3;
}

// The ball comes, and will cross the robot's y a little ahead of it. A ball that keeps its y crosses nowhere.
bool will_cross_ahead(const Sight& sight, std::size_t id) {
  const Pose& robot = sight.now.own[id];
  const Vec2 ball = sight.now.ball;
  const Vec2 move = {ball.x - sight.before.ball.x, ball.y - sight.before.ball.y};
  if (!ball_comes_to(sight, id) || move.y == 0.0) {
    return false;
  }
  const double frames = (robot.y_m - ball.y) / move.y;  // below 0 passes: published
  const double ahead_m = (robot.y_m - ball.y) * move.x / move.y + ball.x - robot.x_m;
  return ahead_m > 0.1 && ahead_m < 0.3 && frames < 10.0;
}

Action nearest(const Sight& sight, std::size_t id) {
  const Vec2 robot = place_of(sight.now.own[id]);
  const Vec2 ball = sight.now.ball;
  if (has_shoot_chance(robot, ball)) {
    return GoTo{ball_in_frames(sight, 2.0), driving};
  }
  if (will_cross_ahead(sight, id)) {
    return TurnTo{bearing_rad(robot, {field_half_length_m, 0.0})};
  }
  if (!(ball.x > -zone_x_m)) {
    return GoTo{{waiting_x_m, ball.y}, placing};
  }
  if (robot.x < ball.x - told_ball_radius_m) {
    return GoTo{ball, driving};
  }
  return GoTo{{ball.x - 0.2, std::abs(ball.y - robot.y) > 0.3 ? ball.y : robot.y}, turning};
}

Action other(Vec2 ball) {
  if (ball.x > -zone_x_m) {
    return GoTo{{ball.x - 0.25, ball.y < 0.0 ? goal_half_width_m : -goal_half_width_m}, placing};
  }
  const double y_m = ball.y < 0.0 ? std::min(-ball.y - 0.5, most_y_m) : std::max(-ball.y + 0.5, -most_y_m);
  return GoTo{{waiting_x_m, y_m}, placing};
}

}  // namespace

Action forward_action(const Sight& sight, std::size_t id, bool is_nearest) {
  const Vec2 robot = place_of(sight.now.own[id]);
  const Vec2 ball = sight.now.ball;
  if (is_in_the_way(robot, ball)) {
    return GoTo{{robot.x - 0.25, ball.y < 0.0 ? ball.y + 0.75 : ball.y - 0.75}, leaving};
  }
  return is_nearest ? nearest(sight, id) : other(ball);
}

Action role_action(const Sight& sight, std::size_t id) {
  switch (role_of(id)) {
    case Role::goalkeeper:
      return goalkeeper_action(sight.now.own[id], sight.now.ball);
    case Role::defender:
      return defender_action(place_of(sight.now.own[id]), sight.now.ball, id == nearest_defender(sight.now));
    case Role::forward:
      break;
  }
  return forward_action(sight, id, id == nearest_forward(sight.now));
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Follows the ball's y along a line before the goal. It predicts nothing.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sil/match/referee/areas.hpp"
#include "sil/match/team/plane.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

constexpr double line_x_m = -field_half_length_m + robot_side_m / 2.0 + 0.05;                      // -3.775
constexpr double most_y_m = goal_half_width_m - robot_side_m / 2.0;                                // 0.425
constexpr double alert_x_m = -field_half_length_m + 1.5 * (field_half_length_m - penalty_line_m);  // -2.55
constexpr double alert_y_m = 1.5 * penalty_half_width_m;                                           // 1.35
constexpr double too_far_left_rad = radians(60.0);

constexpr GoToGains quick = {1.4, 5.0, 0.4, false};
constexpr GoToGains full = {1.4, 5.0, 0.4, true};
constexpr GoToGains clearing = {1.4, 3.0, 0.8, true};

Action with_ball_in_area(const Pose& robot, Vec2 ball, Vec2 home) {
  const Vec2 place = place_of(robot);
  if (ball.x < place.x) {
    if (std::abs(ball.y - place.y) > 0.3) {
      return GoTo{{ball.x - 0.15, place.y}, quick};  // behind the ball
    }
    return TurnTo{std::numbers::pi / 2.0};  // rather than an own goal
  }
  // To the right side it does not look.
  if (wrapped_rad(bearing_rad(place, ball) - robot.heading_rad) > too_far_left_rad) {
    return GoTo{home, quick};
  }
  return GoTo{ball, clearing};
}

}  // namespace

Action goalkeeper_action(const Pose& robot, Vec2 ball) {
  const Vec2 place = place_of(robot);
  const Vec2 home = {line_x_m, std::clamp(ball.y, -most_y_m, most_y_m)};
  if (place.x < -field_half_length_m) {
    return GoTo{{line_x_m, place.y < 0.0 ? place.y + 0.2 : place.y - 0.2}, quick};  // out of the goal
  }
  if (!in_own_penalty_area(place)) {
    return GoTo{home, full};
  }
  if (in_own_penalty_area(ball)) {
    return with_ball_in_area(robot, ball, home);
  }
  // The second condition never decides: a goalkeeper in its area is as near to no such ball.
  if (ball.x < alert_x_m && std::abs(ball.y) < alert_y_m && std::abs(ball.y - place.y) < 0.2) {
    return TurnTo{bearing_rad(place, ball)};
  }
  return GoTo{home, full};
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/rules/sight.hpp"

#include <cmath>

#include "sil/match/referee/areas.hpp"
#include "sil/match/team/plane.hpp"

namespace striker::sil {

Glimpse glimpse_of(const TeamView& view) {
  Glimpse now;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    now.own[id] = view.own[id].pose;
    now.opponents[id] = view.opponents[id].pose;
    now.active[id] = view.own[id].active;
    now.touching[id] = view.own[id].touching;
  }
  now.ball = view.ball_m;
  return now;
}

Vec2 ball_in_frames(const Sight& sight, double frames) {
  const Vec2 ball = sight.now.ball;
  const Vec2 before = sight.before.ball;
  return {ball.x + frames * (ball.x - before.x), ball.y + frames * (ball.y - before.y)};
}

namespace {

std::size_t nearer_of(const Glimpse& now, std::size_t low, std::size_t high) {
  const double low_m = distance_m(place_of(now.own[low]), now.ball);
  const double high_m = distance_m(place_of(now.own[high]), now.ball);
  return high_m < low_m ? high : low;
}

}  // namespace

std::size_t nearest_defender(const Glimpse& now) {
  return nearer_of(now, 1, 2);
}

std::size_t nearest_forward(const Glimpse& now) {
  return nearer_of(now, 3, 4);
}

bool has_shoot_chance(Vec2 robot, Vec2 ball) {
  const double x = ball.x - robot.x;
  const double y = ball.y - robot.y;
  if (!(x > 0.0)) {
    return false;
  }
  return std::abs((field_half_length_m - ball.x) * y / x + robot.y) < goal_half_width_m;
}

bool ball_comes_to(const Sight& sight, std::size_t id) {
  const Pose& robot = sight.now.own[id];
  const Vec2 ball = sight.now.ball;
  const Vec2 before = sight.before.ball;
  return std::abs(robot.x_m - ball.x) < std::abs(robot.x_m - before.x) &&
         std::abs(robot.y_m - ball.y) < std::abs(robot.y_m - before.y);
}

bool in_own_penalty_area(Vec2 spot) {
  return spot.x < -penalty_line_m && std::abs(spot.y) <= penalty_half_width_m;
}

}  // namespace striker::sil

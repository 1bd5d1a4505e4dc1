// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/striker/drive.hpp"
#include "sil/match/team/striker/roles.hpp"
#include "sil/match/team/top_speed.hpp"
#include "sil/world/field_specs.hpp"

namespace striker::sil {

namespace {

Vec2 aim_for(Vec2 ball, const TeamView& view) {
  if (ball.x < -2.2) {  // out to the side
    return {0.0, ball.y > 0.0 ? 2.2 : -2.2};
  }
  if (ball.x > 1.5) {  // past the goalkeeper
    return {3.95,
            std::abs(ball.y) > 1.2 ? 0.0 : (view.opponents[goalkeeper_id].pose.y_m > 0.0 ? -0.28 : 0.28)};
  }
  return {3.95, 0.0};
}

bool is_at_a_wall(Vec2 ball) {
  return std::abs(ball.y) > 2.15 || std::abs(ball.x) > 3.72;
}

}  // namespace

SpeedOrder chase_ball(const Situation& now, std::size_t id) {
  const Pose& robot = now.view.own[id].pose;
  const double top_m_s = top_speed_m_s(id);
  const Vec2 ball = now.interceptions[id].ball;
  const Vec2 aim = aim_for(ball, now.view);
  const double aim_m = distance_m(ball, aim);
  const Vec2 ahead = {(aim.x - ball.x) / aim_m, (aim.y - ball.y) / aim_m};  // from the ball
  const Vec2 way = {ball.x - robot.x_m, ball.y - robot.y_m};
  const double along_m = way.x * ahead.x + way.y * ahead.y;  // the ball is ahead of the robot
  const double aside_m = way.y * ahead.x - way.x * ahead.y;  // and to the left of its line
  const double ball_m = std::sqrt(way.x * way.x + way.y * way.y);
  if (along_m > 0.0 && std::abs(aside_m) < 0.05 + 0.12 * along_m && ball_m < 0.9) {
    return drive_through(robot, {ball.x + 0.1 * ahead.x, ball.y + 0.1 * ahead.y}, top_m_s);
  }
  if (is_at_a_wall(ball) && ball_m < 0.35 && way.x > -0.03) {
    return drive_through(robot, ball, top_m_s);
  }
  Vec2 behind = {ball.x - 0.22 * ahead.x, ball.y - 0.22 * ahead.y};
  if (along_m < 0.05) {  // round the ball, on the robot's side of it
    const double side = aside_m > 0.0 ? 1.0 : -1.0;
    behind = {ball.x - 0.18 * ahead.x + side * 0.26 * ahead.y,
              ball.y - 0.18 * ahead.y - side * 0.26 * ahead.x};
  }
  behind = {std::clamp(behind.x, -3.8, 3.8), std::clamp(behind.y, -2.23, 2.23)};
  return drive_to(robot, behind, top_m_s, 1.0);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sil/match/referee/areas.hpp"
#include "sil/match/team/plane.hpp"
#include "sil/match/team/striker/drive.hpp"
#include "sil/match/team/striker/roles.hpp"
#include "sil/match/team/top_speed.hpp"

namespace striker::sil {

namespace {

constexpr double top_m_s = top_speed_m_s(goalkeeper_id);
constexpr double last_x_m = -3.78;

// On an arc round the goal's centre, between it and the ball.
Vec2 guard_spot(Vec2 ball) {
  const double angle_rad = std::atan2(ball.y, ball.x + field_half_length_m);
  return {std::max(-field_half_length_m + 0.36 * std::cos(angle_rad), last_x_m), 0.45 * std::sin(angle_rad)};
}

// A ball that comes fast is met where it will cross.
Vec2 blocking_spot(const Pose& keeper, const BallTrack& ball) {
  Vec2 spot = guard_spot(ball.now());
  const Vec2 velocity = ball.velocity_m_s();
  if (velocity.x < -0.4) {
    const double time_s = (keeper.x_m + 0.08 - ball.now().x) / velocity.x;
    const double y_m = ball.now().y + velocity.y * time_s;
    if (time_s > 0.0 && time_s < 1.5 && std::abs(y_m) < 0.75) {
      spot = {keeper.x_m > -3.7 && keeper.x_m < -3.55 ? keeper.x_m : -3.72, y_m};
    }
  }
  spot.y = std::clamp(spot.y, -0.47, 0.47);
  return spot;
}

}  // namespace

SpeedOrder keep_goal(const Situation& now) {
  const Pose& keeper = now.view.own[goalkeeper_id].pose;
  const Vec2 place = place_of(keeper);
  const Vec2 ball = now.ball.now();
  const Vec2 velocity = now.ball.velocity_m_s();
  const bool is_mine = ball.x < -penalty_line_m && std::abs(ball.y) < 0.85;
  if (is_mine && ball.x <= place.x + 0.02) {  // it is behind me
    if (distance_m(place, ball) < 0.3 && std::abs(ball.y) > 0.5) {
      return drive_to(keeper, ball, top_m_s, 1.5);
    }
    return drive_to(keeper, {-3.82, ball.y > place.y ? ball.y - 0.35 : ball.y + 0.35}, top_m_s, 0.6);
  }
  if (is_mine && distance_m(place, ball) < 0.6 && std::abs(velocity.x) + std::abs(velocity.y) < 1.2) {
    return drive_to(keeper, {ball.x + 0.2 * (ball.x - place.x), ball.y + 0.2 * (ball.y - place.y)}, top_m_s,
                    1.6);
  }
  return drive_to(keeper, blocking_spot(keeper, now.ball), top_m_s);
}

}  // namespace striker::sil

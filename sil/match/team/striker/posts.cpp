// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sil/match/team/striker/roles.hpp"
#include "sil/match/team/top_speed.hpp"
#include "sil/world/field_specs.hpp"

namespace striker::sil {

namespace {

Vec2 on_arc(Vec2 ball, double radius_m) {
  const double angle_rad = std::atan2(ball.y, ball.x + field_half_length_m);
  return {-field_half_length_m + radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)};
}

Vec2 guard_post(const Situation& now, std::size_t id) {
  const Vec2 ball = now.ball.now();
  const std::size_t other = 3 - id;
  const bool is_left = now.view.own[id].pose.y_m > now.view.own[other].pose.y_m;
  const bool is_on_balls_side = is_left == (ball.y > 0.0);
  Vec2 post;
  if (ball.x >= 0.3) {
    post = {is_on_balls_side ? -1.6 : -1.2, 0.4 * ball.y + (is_left ? 0.45 : -0.45)};
    post.x += ball.x > 1.5 ? 0.7 : 0.0;
  } else if (other == now.chaser || is_on_balls_side) {
    post = on_arc(ball, 1.35);
  } else {
    post = on_arc(ball, 1.6);
    post.y += ball.y > 0.0 ? -0.5 : 0.5;
  }
  post.x = std::max(post.x, -2.75);  // out of the own area
  return post;
}

Vec2 support_post(const Situation& now, std::size_t id) {
  const Vec2 ball = now.ball.now();
  const double other_side = ball.y > 0.0 ? -1.0 : 1.0;
  if (ball.x > 2.4) {
    return {2.45, 0.3 * other_side};
  }
  Vec2 post = {std::min(ball.x - 0.55, 2.2), 0.45 * other_side};
  if (ball.x < -0.5) {
    post.x = std::clamp(ball.x + 0.9, -1.0, 0.6);
  }
  if (role_of(now.chaser) == Role::defender && id == 4) {
    post = {post.x - 0.3, -1.6 * post.y};
  }
  return post;
}

}  // namespace

Vec2 post_of(const Situation& now, std::size_t id) {
  return role_of(id) == Role::defender ? guard_post(now, id) : support_post(now, id);
}

}  // namespace striker::sil

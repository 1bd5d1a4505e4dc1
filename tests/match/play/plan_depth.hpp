// SPDX-License-Identifier: Apache-2.0
// How deep robots and ball are in walls and in each other, seen from above: plane geometry alone, nothing of ODE.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "sil/world/field_specs.hpp"
#include "sil/world/pose.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

struct Square {
  Vec2 centre_m;
  Vec2 ahead;  // unit vector
};

inline Square square_of(const Pose& pose) {
  return {.centre_m = {pose.x_m, pose.y_m},
          .ahead = {std::cos(pose.heading_rad), std::sin(pose.heading_rad)}};
}

// How far a point is from where something may be: the field with its cut corners, or the band between the goals.
inline double depth_in_walls_m(Vec2 point_m) {
  const double x_m = std::abs(point_m.x);
  const double y_m = std::abs(point_m.y);
  const double cut_m =
      (x_m + y_m - (field_half_length_m + field_half_width_m - corner_leg_m)) / std::sqrt(2.0);
  const double from_field_m = std::max({x_m - field_half_length_m, y_m - field_half_width_m, cut_m});
  const double from_goals_m = std::max(x_m - goal_back_m, y_m - goal_half_width_m);
  return std::max(0.0, std::min(from_field_m, from_goals_m));
}

inline double depth_in_walls_m(Vec2 centre_m, double radius_m) {
  const double x_m = std::abs(centre_m.x);
  const double y_m = std::abs(centre_m.y);
  const double before_m = field_half_length_m - x_m;
  const double aside_m = goal_half_width_m - y_m;
  if (aside_m <= 0.0) {
    const double cut_m =
        (x_m + y_m - (field_half_length_m + field_half_width_m - corner_leg_m)) / std::sqrt(2.0);
    return std::max(0.0, std::max({-before_m, y_m - field_half_width_m, cut_m}) + radius_m);
  }
  const double side_m =
      before_m > 0.0 ? std::hypot(before_m, aside_m) : aside_m;  // of a post, or the goal's side
  return std::max({0.0, radius_m - side_m, x_m - goal_back_m + radius_m});
}

inline double across(const Square& square, Vec2 axis) {
  const double ahead = std::abs(square.ahead.x * axis.x + square.ahead.y * axis.y);
  const double left = std::abs(-square.ahead.y * axis.x + square.ahead.x * axis.y);
  return robot_side_m / 2.0 * (ahead + left);
}

inline double depth_in_walls_m(const Square& square) {
  constexpr double half_m = robot_side_m / 2.0;
  const Vec2 left = {-square.ahead.y, square.ahead.x};
  double deepest_m = 0.0;
  for (const double along_m : {-half_m, half_m}) {
    for (const double aside_m : {-half_m, half_m}) {
      const Vec2 corner_m = {square.centre_m.x + along_m * square.ahead.x + aside_m * left.x,
                             square.centre_m.y + along_m * square.ahead.y + aside_m * left.y};
      deepest_m = std::max(deepest_m, depth_in_walls_m(corner_m));
    }
  }
  const Vec2 post_m = {std::copysign(field_half_length_m, square.centre_m.x) - square.centre_m.x,
                       std::copysign(goal_half_width_m, square.centre_m.y) - square.centre_m.y};
  const double ahead_m = std::abs(post_m.x * square.ahead.x + post_m.y * square.ahead.y);
  const double beside_m = std::abs(post_m.x * left.x + post_m.y * left.y);
  return std::max(deepest_m, half_m - std::max(ahead_m, beside_m));
}

// 0 where they are apart (separating axes).
inline double depth_of_squares_m(const Square& one, const Square& other) {
  const Vec2 apart_m = {other.centre_m.x - one.centre_m.x, other.centre_m.y - one.centre_m.y};
  double least_m = robot_side_m;
  for (const Vec2 axis :
       {one.ahead, Vec2{-one.ahead.y, one.ahead.x}, other.ahead, Vec2{-other.ahead.y, other.ahead.x}}) {
    const double gap_m =
        std::abs(apart_m.x * axis.x + apart_m.y * axis.y) - across(one, axis) - across(other, axis);
    least_m = std::min(least_m, -gap_m);
  }
  return std::max(0.0, least_m);
}

}  // namespace striker::sil

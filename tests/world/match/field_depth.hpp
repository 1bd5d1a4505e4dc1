// SPDX-License-Identifier: Apache-2.0
// How deep robots are in walls and in each other, from their poses: squares on the field, seen from above.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "sil/world/pose.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

inline std::array<Vec2, 4> corners_of(const Pose& pose) {
  const double c = 0.5 * robot_side_m * std::cos(pose.heading_rad);
  const double s = 0.5 * robot_side_m * std::sin(pose.heading_rad);
  return {{{pose.x_m + c - s, pose.y_m + s + c},
           {pose.x_m - c - s, pose.y_m - s + c},
           {pose.x_m - c + s, pose.y_m - s - c},
           {pose.x_m + c + s, pose.y_m + s - c}}};
}

// A point's depth in side walls, goal backs, corners and end blocks; 0 on the field.
inline double wall_depth_m(const Vec2& at) {
  const double x = std::abs(at.x);
  const double y = std::abs(at.y);
  const double corner_m = field_half_length_m + field_half_width_m - corner_leg_m;
  const double block_m = std::min(x - field_half_length_m, y - goal_half_width_m);
  return std::max(
      {0.0, y - field_half_width_m, x - goal_back_m, (x + y - corner_m) / std::numbers::sqrt2, block_m});
}

inline double robot_wall_depth_m(const Pose& pose) {
  double deepest_m = 0.0;
  for (const Vec2& corner : corners_of(pose)) {
    deepest_m = std::max(deepest_m, wall_depth_m(corner));
  }
  // A post's edge in the robot.
  const double dx = std::copysign(field_half_length_m, pose.x_m) - pose.x_m;
  const double dy = std::copysign(goal_half_width_m, pose.y_m) - pose.y_m;
  const double along = std::abs(dx * std::cos(pose.heading_rad) + dy * std::sin(pose.heading_rad));
  const double across = std::abs(dy * std::cos(pose.heading_rad) - dx * std::sin(pose.heading_rad));
  return std::max(deepest_m, 0.5 * robot_side_m - std::max(along, across));
}

// By the separating axis: the least way that parts the squares; 0 apart.
inline double robot_robot_depth_m(const Pose& a, const Pose& b) {
  double least_m = 1.0;
  for (const double heading_rad : {a.heading_rad, b.heading_rad}) {
    for (const Vec2 axis : {Vec2{std::cos(heading_rad), std::sin(heading_rad)},
                            Vec2{-std::sin(heading_rad), std::cos(heading_rad)}}) {
      const auto reach = [axis](const Pose& pose) {
        double most = 0.0;
        for (const Vec2& corner : corners_of(pose)) {
          most = std::max(most, (corner.x - pose.x_m) * axis.x + (corner.y - pose.y_m) * axis.y);
        }
        return most;
      };
      const double apart = std::abs((b.x_m - a.x_m) * axis.x + (b.y_m - a.y_m) * axis.y);
      least_m = std::min(least_m, reach(a) + reach(b) - apart);
    }
  }
  return std::max(0.0, least_m);
}

}  // namespace striker::sil

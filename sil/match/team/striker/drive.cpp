// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/drive.hpp"

#include <algorithm>
#include <cmath>

#include "sil/match/team/go_to.hpp"
#include "sil/match/team/plane.hpp"

namespace striker::sil {

namespace {

constexpr double arrived_m = 0.015;
constexpr double near_m = 0.05;        // turns fade out from here on: the bearing is noise
constexpr double braking_per_s = 4.0;  // speed for a metre to go
constexpr double turn_m_s_rad = 0.55;  // of each rim, for an error of heading
constexpr double turn_through_m_s_rad = 0.7;
constexpr double far_off_rad = radians(50.0);
constexpr double far_off_share = 0.3;

struct Facing {
  double error_rad;  // of the end that is nearer
  double direction;  // 1 front, -1 back
};

Facing facing(const Pose& robot, Vec2 target_m) {
  const double error_rad = wrapped_rad(bearing_rad(place_of(robot), target_m) - robot.heading_rad);
  if (std::abs(error_rad) <= std::numbers::pi / 2.0) {
    return {error_rad, 1.0};
  }
  return {wrapped_rad(error_rad + std::numbers::pi), -1.0};
}

SpeedOrder limited(SpeedOrder wheels, double top_m_s) {
  wheels = limited_in_difference(wheels, top_m_s);
  return {std::clamp(wheels.left_m_s, -top_m_s, top_m_s), std::clamp(wheels.right_m_s, -top_m_s, top_m_s)};
}

}  // namespace

SpeedOrder drive_to(const Pose& robot, Vec2 target_m, double top_m_s, double passing_m_s) {
  const double distance = distance_m(place_of(robot), target_m);
  const bool stops = passing_m_s == 0.0;
  if (stops && distance < arrived_m) {
    return {};
  }
  const auto [error_rad, direction] = facing(robot, target_m);
  double speed_m_s = std::min(top_m_s, std::max(passing_m_s, braking_per_s * distance)) * std::cos(error_rad);
  if (std::abs(error_rad) > far_off_rad) {
    speed_m_s *= far_off_share;
  }
  double turn_m_s = turn_m_s_rad * error_rad;
  if (stops && distance < near_m) {
    turn_m_s *= distance / near_m;
  }
  return limited({direction * speed_m_s - turn_m_s, direction * speed_m_s + turn_m_s}, top_m_s);
}

SpeedOrder drive_through(const Pose& robot, Vec2 point_m, double top_m_s) {
  const auto [error_rad, direction] = facing(robot, point_m);
  const double speed_m_s = top_m_s * std::max(0.2, std::cos(error_rad));
  const double turn_m_s = turn_through_m_s_rad * error_rad;
  return limited_in_ratio({direction * speed_m_s - turn_m_s, direction * speed_m_s + turn_m_s}, top_m_s);
}

SpeedOrder face(const Pose& robot, double heading_rad, double top_m_s) {
  const double turn_m_s = turn_m_s_rad * wrapped_rad(heading_rad - robot.heading_rad);
  return limited({-turn_m_s, turn_m_s}, top_m_s);
}

}  // namespace striker::sil

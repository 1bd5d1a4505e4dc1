// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/go_to.hpp"

#include <algorithm>
#include <cmath>

#include "sil/match/team/plane.hpp"

namespace striker::sil {

namespace {

constexpr double behind_rad = radians(95.0);
constexpr double aside_rad = radians(85.0);
constexpr double nearly_ahead_rad = radians(40.0);
constexpr double damping = 0.35;
constexpr double turn_on_the_spot = 0.4;

struct Error {
  double angle_rad;  // of the front, or of the back
  double direction;  // 1 ahead, -1 back
};

Error folded(double angle_rad) {
  if (angle_rad > behind_rad) {
    return {angle_rad - std::numbers::pi, -1.0};
  }
  if (angle_rad < -behind_rad) {
    return {angle_rad + std::numbers::pi, -1.0};
  }
  return {angle_rad, 1.0};
}

// The nearer, the sharper; but not if it is nearly ahead.
double turn_share(double distance_m, double angle_rad) {
  if (distance_m < 5.0 && std::abs(angle_rad) < nearly_ahead_rad) {
    return 0.1;
  }
  if (distance_m > 1.0) {
    return 17.0 / 90.0;
  }
  if (distance_m > 0.5) {
    return 19.0 / 90.0;
  }
  if (distance_m > 0.3) {
    return 21.0 / 90.0;
  }
  return distance_m > 0.2 ? 23.0 / 90.0 : 25.0 / 90.0;
}

struct Steered {
  SpeedOrder wheels;
  bool on_the_spot;
};

Steered steered(const Pose& robot, Vec2 target_m, const GoToGains& gains, ReverseSteering reverse) {
  const double distance = distance_m(place_of(robot), target_m);
  if (!std::isfinite(distance)) {
    return {{}, true};
  }
  const auto [angle_rad, direction] =
      folded(wrapped_rad(bearing_rad(place_of(robot), target_m) - robot.heading_rad));
  if (std::abs(angle_rad) > aside_rad) {
    return {{-gains.turn * angle_rad, gains.turn * angle_rad}, true};
  }
  const double turn = gains.turn * (4.0 * turn_share(distance, angle_rad)) * angle_rad;
  const double ahead = gains.reach * (1.0 / (1.0 + std::exp(-3.0 * distance)) - damping);
  if (reverse == ReverseSteering::published) {
    return {{direction * gains.speed * (ahead - turn), direction * gains.speed * (ahead + turn)}, false};
  }
  return {{gains.speed * (direction * ahead - turn), gains.speed * (direction * ahead + turn)}, false};
}

SpeedOrder finite_or_still(SpeedOrder wheels) {
  return std::isfinite(wheels.left_m_s) && std::isfinite(wheels.right_m_s) ? wheels : SpeedOrder{};
}

}  // namespace

SpeedOrder limited_in_ratio(SpeedOrder wheels, double top_m_s, bool full) {
  const double faster_m_s = std::max(std::abs(wheels.left_m_s), std::abs(wheels.right_m_s));
  if (faster_m_s > top_m_s || full) {
    const double scale = top_m_s / faster_m_s;
    wheels = {wheels.left_m_s * scale, wheels.right_m_s * scale};
  }
  return finite_or_still(wheels);
}

SpeedOrder limited_in_difference(SpeedOrder wheels, double top_m_s) {
  const double over_m_s = std::max(std::max(wheels.left_m_s, wheels.right_m_s) - top_m_s, 0.0);
  wheels = {wheels.left_m_s - over_m_s, wheels.right_m_s - over_m_s};
  const double under_m_s = std::min(std::min(wheels.left_m_s, wheels.right_m_s) + top_m_s, 0.0);
  wheels = {wheels.left_m_s - under_m_s, wheels.right_m_s - under_m_s};
  return finite_or_still(wheels);
}

SpeedOrder wheels_to(const Pose& robot, Vec2 target_m, const GoToGains& gains, ReverseSteering reverse) {
  return steered(robot, target_m, gains, reverse).wheels;
}

SpeedOrder go_to(const Pose& robot, Vec2 target_m, const GoToGains& gains, double top_m_s,
                 ReverseSteering reverse) {
  const auto [wheels, on_the_spot] = steered(robot, target_m, gains, reverse);
  return limited_in_ratio(wheels, top_m_s, gains.full && !on_the_spot);
}

SpeedOrder turn_to(const Pose& robot, double heading_rad, double top_m_s) {
  const double angle_rad = folded(wrapped_rad(heading_rad - robot.heading_rad)).angle_rad;
  return limited_in_ratio({-turn_on_the_spot * angle_rad, turn_on_the_spot * angle_rad}, top_m_s);
}

}  // namespace striker::sil

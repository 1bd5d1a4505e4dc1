// SPDX-License-Identifier: Apache-2.0
// What players compute of places. Nothing here fuses or reorders, so that a player in another language that does the
// same comes to the same bits.
#pragma once

#include <cmath>
#include <numbers>

#include "sil/world/pose.hpp"

namespace striker::sil {

[[nodiscard]] constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

[[nodiscard]] constexpr Vec2 place_of(const Pose& pose) {
  return {pose.x_m, pose.y_m};
}

// A square root and no hypot: libraries differ in the last bit of that.
[[nodiscard]] inline double distance_m(Vec2 a, Vec2 b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

// To [-pi, pi].
[[nodiscard]] inline double wrapped_rad(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

// Of the way from here to there. On the spot it is +90 degrees, as players of AI Soccer have it (AI World Cup examples
// ae937e6): to the left even in a mirror.
[[nodiscard]] inline double bearing_rad(Vec2 from, Vec2 to) {
  const double x = to.x - from.x;
  const double y = to.y - from.y;
  return x == 0.0 && y == 0.0 ? std::numbers::pi / 2.0 : std::atan2(y, x);
}

}  // namespace striker::sil

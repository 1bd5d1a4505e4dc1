// SPDX-License-Identifier: Apache-2.0
// Places on the plane, for what knows no world: see sil/world/world.hpp for the coordinates.
#pragma once

namespace striker::sil {

struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  bool operator==(const Vec2&) const = default;
};

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  bool operator==(const Vec3&) const = default;
};

struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  bool operator==(const Pose&) const = default;
};

}  // namespace striker::sil

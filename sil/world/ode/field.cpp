// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/field.hpp"

#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"

namespace striker::sil {
namespace {

// Solid where a x + b y + c z < d.
GeomHandle plane(double a, double b, double c, double d) {
  return GeomHandle(dCreatePlane(nullptr, a, b, c, d));
}

// The end wall and the goal's side of one quadrant as one solid block: the same faces towards the field as
// AI Soccer's boxes of 25 mm, and nothing fast can tunnel through.
GeomHandle end_block(double side_x, double side_y) {
  constexpr double length_m = 1.0;
  constexpr double width_m = 2.0;
  constexpr double height_m = 2.0;
  GeomHandle box(dCreateBox(nullptr, length_m, width_m, height_m));
  dGeomSetPosition(box.get(), side_x * (field_half_length_m + 0.5 * length_m),
                   side_y * (goal_half_width_m + 0.5 * width_m), 0.5 * height_m);
  return box;
}

}  // namespace

Field make_field(bool walls) {
  Field field;
  field.floor = plane(0.0, 0.0, 1.0, 0.0);
  if (!walls) {
    return field;
  }
  constexpr double diagonal = 0.5 * std::numbers::sqrt2;
  constexpr double corner_m = (field_half_length_m + field_half_width_m - corner_leg_m) * diagonal;
  for (const double side : {-1.0, 1.0}) {
    field.walls.push_back(plane(0.0, -side, 0.0, -field_half_width_m));
    field.walls.push_back(plane(-side, 0.0, 0.0, -goal_back_m));
    for (const double other : {-1.0, 1.0}) {
      field.walls.push_back(end_block(side, other));
      field.walls.push_back(plane(-side * diagonal, -other * diagonal, 0.0, -corner_m));
    }
  }
  field.robot_ceiling = plane(0.0, 0.0, -1.0, -robot_ceiling_m);
  return field;
}

bool near_wall(double x_m, double y_m, double radius_m) {
  constexpr double corner_sum_m = field_half_length_m + field_half_width_m - corner_leg_m;
  const double x = std::abs(x_m);
  const double y = std::abs(y_m);
  return x + radius_m > field_half_length_m || y + radius_m > field_half_width_m ||
         x + y + std::numbers::sqrt2 * radius_m > corner_sum_m;
}

}  // namespace striker::sil

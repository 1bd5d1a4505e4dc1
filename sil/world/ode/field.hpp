// SPDX-License-Identifier: Apache-2.0
// The floor, and the walls as robots meet them (for the ball see ball/walls.hpp), as shapes that never move.
#pragma once

#include <vector>

#include "sil/world/ode/handles.hpp"

namespace striker::sil {

struct Field {
  GeomHandle floor;  // an unbounded plane
  std::vector<GeomHandle> walls;
  GeomHandle robot_ceiling;  // null on an open floor
};

[[nodiscard]] Field make_field(bool walls);

// May a body with this bounding radius, its centre here, touch a wall? Cheap, and never wrongly false.
[[nodiscard]] bool near_wall(double x_m, double y_m, double radius_m);

}  // namespace striker::sil

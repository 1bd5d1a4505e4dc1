// SPDX-License-Identifier: Apache-2.0
// The walls, the goals and the ceiling as the ball's centre meets them: the field less a ball's radius. Here a
// wall is met on the way of a step, from the side that the ball comes from; a test of the place after the step,
// as ODE's, finds a fast ball deep inside a block and takes it out of the nearest face, in the goal at times.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sil/world/vec3.hpp"

namespace striker::sil {

// One wall as seen by a ball: how far its surface is from it (negative inside), and the unit normal to it.
struct WallGap {
  double gap_m;
  Vec3 normal;
};

struct WallHit {
  double share;  // of the way, 0 to 1
  Vec3 normal;   // away from the wall
};

// Side walls and goal backs 4, corners 4, end blocks 4, ceiling 1.
inline constexpr std::size_t ball_wall_count = 13;

// Every wall, in a fixed order.
void wall_gaps(const Vec3& centre_m, std::span<WallGap, ball_wall_count> gaps);

// The first wall on the ball's way; one that it is inside of or touches already, if it moves further in.
[[nodiscard]] std::optional<WallHit> first_wall_hit(const Vec3& from_m, const Vec3& way_m);

}  // namespace striker::sil

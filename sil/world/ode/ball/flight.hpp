// SPDX-License-Identifier: Apache-2.0
// What the walls and the floor do to the ball's way of a step, after ODE has moved it.
#pragma once

#include "sil/world/ode/ode_world.hpp"
#include "sil/world/vec3.hpp"

namespace striker::sil {

struct BallMotion {
  Vec3 position_m;
  Vec3 velocity_m_s;
  Vec3 spin_rad_s;
};

[[nodiscard]] BallMotion motion_of(const Ball& ball);

// How a wall answers: the table's wall_ball, or without a bounce.
enum class Bounce { table, none };

// The ball's impact on a wall with this unit normal, if it approaches: Newton's restitution along the normal, and
// Coulomb's friction at the surface, up to the impulse that ends the slip, 2/7 of it per mass for a solid sphere
// (Cross, "Grip-slip behavior of a bouncing ball", Am. J. Phys. 70, 2002).
[[nodiscard]] BallMotion after_impact(const BallMotion& ball, const Vec3& normal, Bounce bounce);

// ODE has moved the ball straight on from `from_m`. Where a wall is in between, the ball bounces there, and goes
// the rest of its way with the speed after the bounce: it is never inside a wall after a step, its rebound does
// not depend on when in a step it meets the wall, and damping acts once.
void bounce_off_walls(const Ball& ball, const Vec3& from_m, double step_s, Bounce bounce);

// Pressed or fallen into the floor: lifted to where the floor's spring is hardly strained. Its speed stays; the
// floor's contact ends it in the next step.
void keep_above_floor(const Ball& ball);

}  // namespace striker::sil

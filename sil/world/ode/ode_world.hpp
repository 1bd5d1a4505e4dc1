// SPDX-License-Identifier: Apache-2.0
// What every ODE world here has: gravity, damping, softness, and the ball.
#pragma once

#include <cstddef>

#include "sil/world/ode/handles.hpp"
#include "sil/world/physics_constants.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

// Damping: the share of its linear and angular velocity that a body keeps in a step. ODE damps last: a body
// moves with the solved velocity, then loses the rest of it.
[[nodiscard]] double kept_in_step(double step_s, double kept_a_second = kept_after_1_s);

// Worlds that one process steps in several threads at once need a job queue each: the one that ODE gives them
// all is not made for that (it aborts on "m_dependencies_count != 0").
class OdeWorld {
 public:
  // Empty. ODE is initialised once in a process and never closed: worlds come and go at any time.
  explicit OdeWorld(double step_s);
  // Memory for a step that solves so many rows at once, from the first step on.
  void reserve(std::size_t rows);
  [[nodiscard]] dWorldID get() const { return world_.get(); }

 private:
  ThreadingHandle threading_;
  WorldHandle world_;
};

struct Ball {
  dBodyID body = nullptr;
  GeomHandle geom;
};

[[nodiscard]] Ball make_ball(dWorldID world, double kept_a_second, double step_s);

// On the floor, rolling without slip.
void place(const Ball& ball, const BallState& state);
// At rest with its centre at this height, and not below where `place` puts it.
void drop(const Ball& ball, Vec2 position_m, double height_m);
[[nodiscard]] BallState state_of(const Ball& ball);

// For the friction pyramid under the ball. Along the slip the pyramid's force is that of Coulomb's cone, in
// every direction on the field. A rolling ball has no slip before the step in which something hits it: then
// its movement gives the direction.
[[nodiscard]] Vec2 ball_friction_axis(const Ball& ball);

// The contact's horizontal unit normal, from the robot to the ball. A ball on the robot's roof has none: then
// the line of centres.
[[nodiscard]] Vec2 contact_direction(const dContactGeom& contact, dBodyID robot, dBodyID ball);

}  // namespace striker::sil

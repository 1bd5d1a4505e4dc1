// SPDX-License-Identifier: Apache-2.0
// What happens where two materials touch: AI Soccer's contact table, at any physics step.
#pragma once

#include <ode/ode.h>

#include <cstddef>

namespace striker::sil {

// ODE's softness of a constraint: the share of the error corrected in a step, and the constraint force
// mixing.
struct Softness {
  double erp = 0.0;
  double cfm = 0.0;
};

// All figures of the table hold at this step.
inline constexpr double reference_step_s = 0.010;
// Hinges, motors and friction.
inline constexpr Softness world_softness = {.erp = 0.15, .cfm = 1e-5};

// The same spring and damper at another step: kp = ERP / (0.01 CFM), kd = (1 - ERP) / CFM, and at step h
// ERP = h kp / (h kp + kd), CFM = 1 / (h kp + kd) (ODE manual, "How to use ERP and CFM"). With CFM 0 the
// constraint is rigid, there is no spring, and both are kept; with ERP 0 there is only the damper, and the
// formula keeps both by itself.
[[nodiscard]] Softness soften(const Softness& at_reference_step, double step_s);

// The stiffness of that spring in N/m.
[[nodiscard]] double spring_N_m(const Softness& at_reference_step);

// Left and right of a robot are exactly alike. On such ties ODE's solver gives up ("LCP internal error,
// s <= 0") and leaves the forces of the step incomplete, in about 4 of 100,000 steps. So no two contacts of a
// step are equally soft and no two motors of a robot equally strong, by this share.
inline constexpr double tie_break = 1e-6;

// The pairs that can meet. Wheels lie inside the body's box, so they touch nothing but the floor.
enum class Pair {
  floor_body,
  floor_wheel,
  floor_ball,
  wall_body,
  wall_ball,
  body_body,
  goalkeeper_ball,
  body_ball,
  held_wall_ball,  // not of the table: see ball/held.hpp
  held_body_ball
};
inline constexpr std::size_t pair_count = 10;

[[nodiscard]] dSurfaceParameters surface(Pair pair, double step_s);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Energies from what a world shows.
#pragma once

#include <cmath>

#include "sil/world/field_specs.hpp"
#include "sil/world/robot_specs.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

// Body and wheels moving and turning about the vertical, and the wheels' spin.
inline double robot_energy_J(const World& world, std::size_t robot, const RobotSpec& spec) {
  const Vec2 velocity = world.robot_velocity_m_s(robot);
  const double turn = world.yaw_rate_rad_s(robot);
  const double half_axle_m = 0.5 * spec.axle_length_m;
  const double mass_kg = spec.body_mass_kg + 2.0 * spec.wheel_mass_kg;
  const double inertia_kg_m2 = spec.body_mass_kg * robot_side_m * robot_side_m / 6.0 +
                               2.0 * spec.wheel_mass_kg * half_axle_m * half_axle_m;
  double energy_J =
      0.5 * mass_kg * (velocity.x * velocity.x + velocity.y * velocity.y) + 0.5 * inertia_kg_m2 * turn * turn;
  for (const Wheel wheel : wheels) {
    const double rim_m_s = world.rim_speed_m_s(robot, wheel);
    energy_J += 0.25 * spec.wheel_mass_kg * rim_m_s * rim_m_s;  // a disc
  }
  return energy_J;
}

// Moving and lifted; its spin is not shown.
inline double ball_energy_J(const World& world) {
  const BallInSpace ball = world.ball_in_space();
  const Vec3& v = ball.velocity_m_s;
  return 0.5 * ball_mass_kg * (v.x * v.x + v.y * v.y + v.z * v.z) +
         ball_mass_kg * gravity_m_s2 * (ball.position_m.z - ball_radius_m);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// A robot on the plane: one body on two driven wheels, in closed form. Nothing is in its way.
//
// Each wheel is a velocity servo with a torque ceiling, at the rim a force: it does what reaches the
// set-point in this step, and no more than ceiling / wheel radius, nor than the tyre's grip (mu times half the
// weight; a forward's mu is 3). Tyres do not slip, along or across. What the forces push is the whole mass and the wheels'
// spin (solid cylinders, half a wheel's mass each at the rim): a forward's 1.5 + 2 (0.1 + 0.05) = 1.8 kg,
// 11.1 m/s^2 from 0.4 N m a wheel.
//
// One step, in ODE's order: new speeds from the forces, the body moves straight on with them, then damping.
// In the step after a turn the tyres bend the velocity, which points along the old heading, into the new one
// and keep its share along it. A wheel's movement and spin turn likewise, and lose the same share.
//
// Left out: the tyres' softness (they creep 0.1 mm/s at full torque) and width, and the body's pitch. What
// that costs is measured in tests/world/planar_world_test.cpp.
#pragma once

#include <algorithm>
#include <array>

#include "sil/world/physics_constants.hpp"
#include "sil/world/robot_specs.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

struct WheelServo {
  double rim_speed_m_s = 0.0;
  double torque_ceiling_Nm = 0.0;
};
using WheelServos = std::array<WheelServo, 2>;  // in the order of Wheel

struct PlanarRobot {
  Pose pose;
  Vec2 heading{1.0, 0.0};  // the unit vector of pose.heading_rad
  Vec2 velocity_m_s;
  double yaw_rate_rad_s = 0.0;
  double turned_cos = 1.0;  // of the angle that the last step turned
};

// What the plane needs of a robot.
struct PlanarModel {
  double wheel_radius_m;
  double half_axle_m;
  double mass_kg;  // the wheels' spin included
  double
      own_inertia_kgm2;  // body (a box) and wheels (cylinders) about the vertical axis, which no turn changes
  double wheel_inertia_kgm2;  // of the wheels' movement and spin about that axis
  double inertia_kgm2;        // both
  double grip_N;              // of one tyre
  bool operator==(const PlanarModel&) const = default;
};

[[nodiscard]] constexpr PlanarModel planar_model(const RobotSpec& spec) {
  // What a wheel weighs that rolls: its spin counts half its mass more. 15 / 10, as 1.5 times 0.1 rounds to
  // another double than 0.15.
  const double rolling_wheel_kg = 15.0 * spec.wheel_mass_kg / 10.0;
  const double half_axle_m = 0.5 * spec.axle_length_m;
  const double own_kgm2 =
      spec.body_mass_kg * (robot_side_m * robot_side_m + robot_side_m * robot_side_m) / 12.0 +
      2.0 * spec.wheel_mass_kg *
          (3.0 * spec.wheel_radius_m * spec.wheel_radius_m + wheel_thickness_m * wheel_thickness_m) / 12.0;
  const double wheel_kgm2 = 2.0 * rolling_wheel_kg * half_axle_m * half_axle_m;
  return {.wheel_radius_m = spec.wheel_radius_m,
          .half_axle_m = half_axle_m,
          .mass_kg = spec.body_mass_kg + 2.0 * rolling_wheel_kg,
          .own_inertia_kgm2 = own_kgm2,
          .wheel_inertia_kgm2 = wheel_kgm2,
          .inertia_kgm2 = own_kgm2 + wheel_kgm2,
          .grip_N = spec.tyre_friction * gravity_m_s2 * (spec.body_mass_kg + 2.0 * spec.wheel_mass_kg) / 2.0};
}

inline constexpr PlanarModel planar_forward = planar_model(robot_spec(Role::forward));

[[nodiscard]] PlanarRobot planar_robot(const Pose& pose);  // at rest

// `kept` is the share of the velocity that damping leaves, kept_in_step(step_s).
void step(PlanarRobot& robot, const PlanarModel& model, const WheelServos& servos, double step_s,
          double kept);

// The largest force of a wheel at its rim.
[[nodiscard]] constexpr double rim_force_limit_N(const PlanarModel& model, const WheelServo& servo) {
  return std::min(servo.torque_ceiling_Nm / model.wheel_radius_m, model.grip_N);
}

// Straight ahead, both wheels alike: the most that the body's speed changes by in a step, before damping.
[[nodiscard]] constexpr double straight_gain_limit_m_s(const PlanarModel& model, const WheelServo& servo,
                                                       double step_s) {
  return step_s * 2.0 * rim_force_limit_N(model, servo) / model.mass_kg;
}

// The speed that it moves with in this step.
[[nodiscard]] constexpr double straight_speed_m_s(double speed_m_s, const WheelServo& servo, double step_s,
                                                  const PlanarModel& model = planar_forward) {
  const double most = straight_gain_limit_m_s(model, servo, step_s);
  return speed_m_s + std::clamp(servo.rim_speed_m_s - speed_m_s, -most, most);
}

// Speed along the heading, signed.
[[nodiscard]] double speed_m_s(const PlanarRobot& robot);
[[nodiscard]] double rim_speed_m_s(const PlanarRobot& robot, const PlanarModel& model, Wheel wheel);

}  // namespace striker::sil

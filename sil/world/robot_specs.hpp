// SPDX-License-Identifier: Apache-2.0
// Size, mass and drive limits of a robot, and those of AI Soccer (a box on two driven wheels and two skids).
#pragma once

#include "firmware/core/robot_profile.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {

enum class Role { goalkeeper, defender, forward };

// A robot as the world sees it. Its body is AI Soccer's box, whatever the rest.
struct RobotSpec {
  Role role;  // what the ball bounces off: a goalkeeper's body takes more of its speed
  double body_mass_kg;
  double wheel_mass_kg;  // each
  double wheel_radius_m;
  double axle_length_m;        // between the wheels' centres
  double max_rim_speed_m_s;    // the servo's limit
  double max_wheel_torque_Nm;  // each
  double tyre_friction = sil::tyre_friction;
};

// In SI units what the firmware's description of the robot says.
[[nodiscard]] constexpr RobotSpec spec_of(const core::RobotDescription& robot, Role role = Role::forward) {
  return {.role = role,
          .body_mass_kg = robot.body_mass_g / 1e3,
          .wheel_mass_kg = robot.wheel_mass_g / 1e3,
          .wheel_radius_m = robot.wheel_radius_um / 1e6,
          .axle_length_m = robot.axle_length_um / 1e6,
          .max_rim_speed_m_s = robot.top_rim_speed_mm_s / 1e3,
          .max_wheel_torque_Nm = robot.torque_limit_mNm / 1e3,
          .tyre_friction = robot.tyre_friction_percent / 1e2};
}

[[nodiscard]] constexpr RobotSpec robot_spec(Role role) {
  switch (role) {
    case Role::goalkeeper:
      return spec_of(core::goalkeeper, role);
    case Role::defender:
      return spec_of(core::defender, role);
    case Role::forward:
      break;
  }
  return spec_of(core::forward, role);
}

static_assert(robot_spec(Role::forward).max_wheel_torque_Nm == 0.4 &&
              robot_spec(Role::forward).max_rim_speed_m_s == 2.55 &&
              robot_spec(Role::forward).body_mass_kg == 1.5 &&
              robot_spec(Role::forward).tyre_friction == tyre_friction);

inline constexpr double robot_side_m = 0.15;  // length and width
inline constexpr double robot_bottom_m = 0.002;
inline constexpr double robot_top_m = 0.090;
inline constexpr double centre_of_mass_height_m = 0.015;
inline constexpr double wheel_thickness_m = 0.004;
inline constexpr double skid_radius_m = 0.002;
inline constexpr double skid_offset_m = 0.071;  // front and rear, along the heading

}  // namespace striker::sil

// Size, mass and drive limits of the AI Soccer robots (a box on two driven wheels and two skids).
#pragma once

#include "sil/world/world.hpp"

namespace striker::sil {

struct RobotSpec {
  double body_mass_kg;
  double wheel_mass_kg;        // each
  double max_rim_speed_m_s;    // the servo's limit
  double max_wheel_torque_Nm;  // each
};

[[nodiscard]] constexpr RobotSpec robot_spec(Role role) {
  switch (role) {
    case Role::goalkeeper:
      return {
          .body_mass_kg = 2.5, .wheel_mass_kg = 0.15, .max_rim_speed_m_s = 1.80, .max_wheel_torque_Nm = 0.8};
    case Role::defender:
      return {
          .body_mass_kg = 2.0, .wheel_mass_kg = 0.10, .max_rim_speed_m_s = 2.10, .max_wheel_torque_Nm = 1.2};
    case Role::forward:
      break;
  }
  return {.body_mass_kg = 1.5, .wheel_mass_kg = 0.10, .max_rim_speed_m_s = 2.55, .max_wheel_torque_Nm = 0.4};
}

inline constexpr double robot_side_m = 0.15;  // length and width
inline constexpr double robot_bottom_m = 0.002;
inline constexpr double robot_top_m = 0.090;
inline constexpr double centre_of_mass_height_m = 0.015;
inline constexpr double wheel_radius_m = 0.04;
inline constexpr double wheel_thickness_m = 0.004;
inline constexpr double axle_length_m = 0.14;  // between the wheels' centres
inline constexpr double skid_radius_m = 0.002;
inline constexpr double skid_offset_m = 0.071;  // front and rear, along the heading

}  // namespace striker::sil

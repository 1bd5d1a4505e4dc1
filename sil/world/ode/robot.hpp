// SPDX-License-Identifier: Apache-2.0
// One robot as ODE sees it: a box on two hinged cylinder wheels and two frictionless skids.
#pragma once

#include <array>
#include <optional>

#include "sil/world/ode/handles.hpp"
#include "sil/world/vec3.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

struct Robot {
  RobotSpec spec = robot_spec(Role::forward);
  dBodyID body = nullptr;
  std::array<dBodyID, 2> wheels{};  // in the order of Wheel
  std::array<dJointID, 2> hinges{};
  GeomHandle box;
  std::array<GeomHandle, 2> skids;
  std::array<GeomHandle, 2> tyres;
  std::array<double, 2> torques_Nm{};
  std::optional<Vec2> ball_contact;  // in the last step
  bool touched_ball = false;         // since its owner last asked
  bool on_field = true;
};

struct Ball;

// Reaches every point of the robot from its centre of mass, seen from above, however it lies.
inline constexpr double robot_reach_m = 0.15;

// Seen from above, are they near enough?
[[nodiscard]] bool may_touch(const Robot& robot, const Ball& ball);
[[nodiscard]] bool may_touch(const Robot& a, const Robot& b);

[[nodiscard]] Robot make_robot(dWorldID world, const RobotSpec& spec);

void place(Robot& robot, const Pose& pose);
// There too, but ODE steps it no more.
void remove(Robot& robot, const Pose& to);

// After a step: has the robot, as one, move at these speeds on the plane {x, y, turn} and be where they take it in
// the step instead of those that it had.
void move_instead(const Robot& robot, const Vec3& speeds, double step_s);

void set_servo(Robot& robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm);
void set_torque(Robot& robot, Wheel wheel, double torque_Nm);
// ODE forgets torques after each step: to be called before it.
void apply_torques(const Robot& robot);

// For the tyres' friction pyramid: its corners point along the robot and across. ODE limits friction by the
// normal forces as they are without friction, where the motors' reaction tilts the robot off its wheels; with
// the pyramid's sides along the robot, the wheels would then spin at full torque (9.6 instead of 11.1 m/s^2
// for a forward), and with the world's axes only for some headings. Coulomb's cone lets them grip.
[[nodiscard]] Vec2 tyre_friction_axis(const Robot& robot);

[[nodiscard]] double rim_speed_m_s(const Robot& robot, Wheel wheel);
[[nodiscard]] double heading_rad(const Robot& robot);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/world/planar_robot.hpp"

#include <algorithm>
#include <cmath>

namespace striker::sil {
namespace {

// The speeds along the heading and about the vertical axis.
struct Twist {
  double speed_m_s;
  double yaw_rate_rad_s;
};

constexpr bool alike(const WheelServo& a, const WheelServo& b) {
  return a.rim_speed_m_s == b.rim_speed_m_s && a.torque_ceiling_Nm == b.torque_ceiling_Nm;
}

// Each wheel's force moves the other rim a little, too: 10 % of its own. Solved by turns (Gauss-Seidel), a
// hundred times nearer each time.
Twist turning(const Twist& before, const PlanarModel& model, const WheelServos& servos, double step_s) {
  constexpr int turns = 8;
  const double half_axle_m = model.half_axle_m;
  const double both = 1.0 / model.mass_kg;
  const double lever = half_axle_m * half_axle_m / model.inertia_kgm2;
  const double own = both + lever;
  const double other = both - lever;
  const std::array wanted = {
      servos[0].rim_speed_m_s - (before.speed_m_s - half_axle_m * before.yaw_rate_rad_s),
      servos[1].rim_speed_m_s - (before.speed_m_s + half_axle_m * before.yaw_rate_rad_s)};
  const std::array limits = {rim_force_limit_N(model, servos[0]), rim_force_limit_N(model, servos[1])};
  std::array force_N = {0.0, 0.0};
  for (int i = 0; i < turns; ++i) {
    force_N[0] = std::clamp((wanted[0] / step_s - other * force_N[1]) / own, -limits[0], limits[0]);
    force_N[1] = std::clamp((wanted[1] / step_s - other * force_N[0]) / own, -limits[1], limits[1]);
  }
  return {before.speed_m_s + step_s * (force_N[0] + force_N[1]) / model.mass_kg,
          before.yaw_rate_rad_s + step_s * half_axle_m * (force_N[1] - force_N[0]) / model.inertia_kgm2};
}

}  // namespace

PlanarRobot planar_robot(const Pose& pose) {
  return {.pose = pose,
          .heading = {std::cos(pose.heading_rad), std::sin(pose.heading_rad)},
          .velocity_m_s = {},
          .yaw_rate_rad_s = 0.0,
          .turned_cos = 1.0};
}

double speed_m_s(const PlanarRobot& robot) {
  return robot.velocity_m_s.x * robot.heading.x + robot.velocity_m_s.y * robot.heading.y;
}

double rim_speed_m_s(const PlanarRobot& robot, const PlanarModel& model, Wheel wheel) {
  const double outwards = wheel == Wheel::left ? -model.half_axle_m : model.half_axle_m;
  return speed_m_s(robot) + outwards * robot.yaw_rate_rad_s;
}

void step(PlanarRobot& robot, const PlanarModel& model, const WheelServos& servos, double step_s,
          double kept) {
  Twist twist{speed_m_s(robot), robot.yaw_rate_rad_s};
  if (twist.yaw_rate_rad_s == 0.0 && alike(servos[0], servos[1])) {
    twist.speed_m_s = straight_speed_m_s(twist.speed_m_s, servos[0], step_s, model);
  } else {
    twist.yaw_rate_rad_s *=
        (model.own_inertia_kgm2 + model.wheel_inertia_kgm2 * robot.turned_cos) / model.inertia_kgm2;
    twist = turning(twist, model, servos, step_s);
  }
  const Vec2 velocity{twist.speed_m_s * robot.heading.x, twist.speed_m_s * robot.heading.y};
  robot.pose.x_m += step_s * velocity.x;
  robot.pose.y_m += step_s * velocity.y;
  robot.turned_cos = 1.0;
  if (twist.yaw_rate_rad_s != 0.0) {
    // ODE adds the rate to the quaternion: a little less than the rate times the step.
    const double turn_rad = 2.0 * std::atan(0.5 * step_s * twist.yaw_rate_rad_s);
    robot.turned_cos = std::cos(turn_rad);
    robot.pose.heading_rad = std::remainder(robot.pose.heading_rad + turn_rad, 2.0 * M_PI);
    robot.heading = {std::cos(robot.pose.heading_rad), std::sin(robot.pose.heading_rad)};
  }
  robot.velocity_m_s = {kept * velocity.x, kept * velocity.y};
  robot.yaw_rate_rad_s = kept * twist.yaw_rate_rad_s;
}

}  // namespace striker::sil

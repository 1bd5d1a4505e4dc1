// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/robot.hpp"

#include <cmath>
#include <cstddef>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/physics_constants.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

constexpr std::size_t index(Wheel wheel) {
  return static_cast<std::size_t>(wheel);
}
// Wheels along the body's y axis, skids along its x axis.
std::array<double, 2> wheel_sides(const RobotSpec& spec) {
  return {0.5 * spec.axle_length_m, -0.5 * spec.axle_length_m};
}
constexpr std::array<double, 2> skid_places = {skid_offset_m, -skid_offset_m};

// Standing, the robot sinks in by its weight over the springs of its contacts, two a wheel and one a skid.
// Placed there, it neither falls nor rises.
double rest_depth_m(const RobotSpec& spec) {
  constexpr double contacts = 6.0;
  const double weight_N = gravity_m_s2 * (spec.body_mass_kg + 2.0 * spec.wheel_mass_kg);
  return weight_N / (contacts * spring_N_m(world_softness));
}

void add_body(Robot& robot, dWorldID world) {
  constexpr double height_m = robot_top_m - robot_bottom_m;
  robot.body = dBodyCreate(world);
  // A box's inertia: AI Soccer names the mass and its centre only.
  dMass mass;
  dMassSetBoxTotal(&mass, robot.spec.body_mass_kg, robot_side_m, robot_side_m, height_m);
  dBodySetMass(robot.body, &mass);
  dBodySetPosition(robot.body, 0.0, 0.0, centre_of_mass_height_m);

  robot.box.reset(dCreateBox(nullptr, robot_side_m, robot_side_m, height_m));
  dGeomSetBody(robot.box.get(), robot.body);
  dGeomSetOffsetPosition(robot.box.get(), 0.0, 0.0,
                         0.5 * (robot_bottom_m + robot_top_m) - centre_of_mass_height_m);
  for (std::size_t i = 0; i < robot.skids.size(); ++i) {
    robot.skids[i].reset(dCreateSphere(nullptr, skid_radius_m));
    dGeomSetBody(robot.skids[i].get(), robot.body);
    dGeomSetOffsetPosition(robot.skids[i].get(), skid_places[i], 0.0,
                           skid_radius_m - centre_of_mass_height_m);
  }
}

void add_wheel(Robot& robot, dWorldID world, std::size_t i) {
  constexpr int along_y = 2;
  const std::array<double, 2> sides = wheel_sides(robot.spec);
  dBodyID wheel = dBodyCreate(world);
  dMass mass;
  dMassSetCylinderTotal(&mass, robot.spec.wheel_mass_kg, along_y, robot.spec.wheel_radius_m,
                        wheel_thickness_m);
  dBodySetMass(wheel, &mass);
  dBodySetPosition(wheel, 0.0, sides[i], robot.spec.wheel_radius_m);

  robot.tyres[i].reset(dCreateCylinder(nullptr, robot.spec.wheel_radius_m, wheel_thickness_m));
  dGeomSetBody(robot.tyres[i].get(), wheel);
  dMatrix3 on_edge;
  dRFromAxisAndAngle(on_edge, 1.0, 0.0, 0.0, 0.5 * M_PI);
  dGeomSetOffsetRotation(robot.tyres[i].get(), on_edge);

  dJointID hinge = dJointCreateHinge(world, nullptr);
  dJointAttach(hinge, wheel, robot.body);
  dJointSetHingeAnchor(hinge, 0.0, sides[i], robot.spec.wheel_radius_m);
  dJointSetHingeAxis(hinge, 0.0, 1.0, 0.0);
  robot.wheels[i] = wheel;
  robot.hinges[i] = hinge;
}

void set_on_field(Robot& robot, bool on_field) {
  const auto set = on_field ? dBodyEnable : dBodyDisable;
  set(robot.body);
  set(robot.wheels[0]);
  set(robot.wheels[1]);
  robot.on_field = on_field;
}

void place_body(dBodyID body, const Pose& pose, double height_m) {
  const dQuaternion turned = {std::cos(0.5 * pose.heading_rad), 0.0, 0.0, std::sin(0.5 * pose.heading_rad)};
  dBodySetPosition(body, pose.x_m, pose.y_m, height_m);
  dBodySetQuaternion(body, turned);
  dBodySetLinearVel(body, 0.0, 0.0, 0.0);
  dBodySetAngularVel(body, 0.0, 0.0, 0.0);
  dBodySetForce(body, 0.0, 0.0, 0.0);
  dBodySetTorque(body, 0.0, 0.0, 0.0);
}

}  // namespace

double distance_squared(dBodyID a, dBodyID b) {
  const dReal* p = dBodyGetPosition(a);
  const dReal* q = dBodyGetPosition(b);
  return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

bool may_touch(const Robot& robot, const Ball& ball) {
  constexpr double reach_m = robot_reach_m + ball_radius_m;
  return robot.on_field && distance_squared(robot.body, ball.body) <= reach_m * reach_m;
}

bool may_touch(const Robot& a, const Robot& b) {
  return a.on_field && b.on_field && distance_squared(a.body, b.body) < 4.0 * robot_reach_m * robot_reach_m;
}

Robot make_robot(dWorldID world, const RobotSpec& spec) {
  Robot robot;
  robot.spec = spec;
  add_body(robot, world);
  for (std::size_t i = 0; i < robot.wheels.size(); ++i) {
    add_wheel(robot, world, i);
  }
  return robot;
}

void place(Robot& robot, const Pose& pose) {
  const std::array<double, 2> sides = wheel_sides(robot.spec);
  const double sink_m = rest_depth_m(robot.spec);
  place_body(robot.body, pose, centre_of_mass_height_m - sink_m);
  for (std::size_t i = 0; i < robot.wheels.size(); ++i) {
    Pose wheel = pose;
    wheel.x_m -= std::sin(pose.heading_rad) * sides[i];
    wheel.y_m += std::cos(pose.heading_rad) * sides[i];
    place_body(robot.wheels[i], wheel, robot.spec.wheel_radius_m - sink_m);
  }
  set_torque(robot, Wheel::left, 0.0);
  set_torque(robot, Wheel::right, 0.0);
  robot.ball_contact.reset();
  robot.touched_ball = false;
  set_on_field(robot, true);
}

void remove(Robot& robot, const Pose& to) {
  place(robot, to);
  set_on_field(robot, false);
}

void move_instead(const Robot& robot, const Vec3& speeds, double step_s) {
  const dReal* linear = dBodyGetLinearVel(robot.body);
  const Vec3 more = speeds - Vec3{linear[0], linear[1], dBodyGetAngularVel(robot.body)[2]};
  const dReal* body_at = dBodyGetPosition(robot.body);
  const std::array centre_m = {body_at[0], body_at[1]};
  dQuaternion turned;
  dQFromAxisAndAngle(turned, 0.0, 0.0, 1.0, more.z * step_s);
  for (dBodyID body : {robot.body, robot.wheels[0], robot.wheels[1]}) {
    const dReal* at = dBodyGetPosition(body);
    const Vec2 more_m_s{more.x - more.z * (at[1] - centre_m[1]), more.y + more.z * (at[0] - centre_m[0])};
    const dReal* moves = dBodyGetLinearVel(body);
    dBodySetLinearVel(body, moves[0] + more_m_s.x, moves[1] + more_m_s.y, moves[2]);
    const dReal* turns = dBodyGetAngularVel(body);
    dBodySetAngularVel(body, turns[0], turns[1], turns[2] + more.z);
    dBodySetPosition(body, at[0] + step_s * more_m_s.x, at[1] + step_s * more_m_s.y, at[2]);
    dQuaternion attitude;
    dQMultiply0(attitude, turned, dBodyGetQuaternion(body));
    dBodySetQuaternion(body, attitude);
  }
}

void set_servo(Robot& robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm) {
  dJointID hinge = robot.hinges[index(wheel)];
  dJointSetHingeParam(hinge, dParamVel, rim_speed_m_s / robot.spec.wheel_radius_m);
  dJointSetHingeParam(hinge, dParamFMax, torque_ceiling_Nm * (wheel == Wheel::left ? 1.0 : 1.0 - tie_break));
  robot.torques_Nm[index(wheel)] = 0.0;
}

void set_torque(Robot& robot, Wheel wheel, double torque_Nm) {
  set_servo(robot, wheel, 0.0, 0.0);
  robot.torques_Nm[index(wheel)] = torque_Nm;
}

void apply_torques(const Robot& robot) {
  for (std::size_t i = 0; i < robot.hinges.size(); ++i) {
    if (robot.torques_Nm[i] != 0.0) {
      dJointAddHingeTorque(robot.hinges[i], robot.torques_Nm[i]);
    }
  }
}

Vec2 tyre_friction_axis(const Robot& robot) {
  const dReal* rotation = dBodyGetRotation(robot.body);
  return {rotation[0] - rotation[4], rotation[0] + rotation[4]};
}

double rim_speed_m_s(const Robot& robot, Wheel wheel) {
  return robot.spec.wheel_radius_m * dJointGetHingeAngleRate(robot.hinges[index(wheel)]);
}

double heading_rad(const Robot& robot) {
  const dReal* rotation = dBodyGetRotation(robot.body);
  return std::atan2(rotation[4], rotation[0]);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/pile/pile_up.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sil/world/ode/ode_world.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

constexpr std::size_t largest_exact = 2;
// Cosine of the tilt beyond which a robot's wheels do not drive it: 37 degrees.
constexpr double wheels_up = 0.8;
// Cosine of the tilt up to which the model moves a robot: 18 degrees. Beyond it the robot is a body of the model
// that others press on, but it moves by its exact contacts: a planar model would turn it over.
constexpr double standing_up = 0.95;
// A contact that is steeper than 45 degrees carries a robot rather than pushes it, and stays exact.
constexpr double level_normal = 0.7;

// The model's forces are not quite those that stop the full robots: what depth this leaves is taken out, as fast
// as this.
constexpr double kept_depth_m = 0.002;
constexpr double part_per_s = 10.0;
constexpr double fastest_part_m_s = 0.3;

constexpr std::size_t up_z = 10;  // of ODE's rotation: row z, column z

bool is_on_wheels(const Robot& robot) {
  return dBodyGetRotation(robot.body)[up_z] > wheels_up;
}

bool is_standing(const Robot& robot) {
  return dBodyGetRotation(robot.body)[up_z] > standing_up;
}

bool is_level(const dContactGeom& contact) {
  return std::hypot(contact.normal[0], contact.normal[1]) > level_normal;
}

PlanarDrive drive_of(const Robot& robot, std::size_t wheel, double grip_N) {
  const double radius_m = robot.spec.wheel_radius_m;
  if (const double torque_Nm = robot.torques_Nm[wheel]; torque_Nm != 0.0) {
    // A torque pulls towards a speed that is never reached.
    constexpr double never_m_s = 1e3;
    return {.rim_speed_m_s = std::copysign(never_m_s, torque_Nm),
            .force_N = std::min(std::abs(torque_Nm) / radius_m, grip_N)};
  }
  const double ceiling_Nm = dJointGetHingeParam(robot.hinges[wheel], dParamFMax);
  return {.rim_speed_m_s = dJointGetHingeParam(robot.hinges[wheel], dParamVel) * radius_m,
          .force_N = std::min(ceiling_Nm / radius_m, grip_N)};
}

PileRobot planar(const Robot& robot) {
  // Standing, a robot's six contacts with the floor carry it alike, and four of them are the tyres'.
  constexpr double on_tyres = 4.0 / 6.0;
  const RobotSpec& spec = robot.spec;
  const double mass_kg = spec.body_mass_kg + 2.0 * spec.wheel_mass_kg;
  const double grip_N = is_on_wheels(robot) ? spec.tyre_friction * on_tyres * mass_kg * gravity_m_s2 : 0.0;
  const double half_axle_m = 0.5 * spec.axle_length_m;
  const dReal* position = dBodyGetPosition(robot.body);
  const dReal* velocity = dBodyGetLinearVel(robot.body);
  return {.pose = {.x_m = position[0], .y_m = position[1], .heading_rad = heading_rad(robot)},
          .velocity_m_s = {velocity[0], velocity[1]},
          .yaw_rate_rad_s = dBodyGetAngularVel(robot.body)[2],
          // A disc's spin counts half its mass; turning, each wheel counts one and a half at half the axle.
          .mass_along_kg = mass_kg + spec.wheel_mass_kg,
          .mass_across_kg = mass_kg,
          .inertia_kg_m2 = spec.body_mass_kg * robot_side_m * robot_side_m / 6.0 +
                           3.0 * spec.wheel_mass_kg * half_axle_m * half_axle_m,
          .half_axle_m = half_axle_m,
          .drives = {drive_of(robot, 0, 0.5 * grip_N), drive_of(robot, 1, 0.5 * grip_N)},
          .grip_N = grip_N};
}

PlanarContact planar(const dContactGeom& geom, const dSurfaceParameters& surface) {
  const double length = std::hypot(geom.normal[0], geom.normal[1]);
  return {.a = 0,
          .b = {},
          .at_m = {geom.pos[0], geom.pos[1]},
          .normal = {geom.normal[0] / length, geom.normal[1] / length},
          .bounce = (surface.mode & dContactBounce) != 0 ? surface.bounce : 0.0,
          .friction = surface.mu,
          .part_m_s = std::clamp((geom.depth - kept_depth_m) * part_per_s, 0.0, fastest_part_m_s)};
}

// At the height of the centre of mass: the model knows no tilt, so its forces must not make one.
void push(const Robot& robot, const dContactGeom& at, Vec2 impulse_Ns, double per_s) {
  dBodyAddForceAtPos(robot.body, per_s * impulse_Ns.x, per_s * impulse_Ns.y, 0.0, at.pos[0], at.pos[1],
                     dBodyGetPosition(robot.body)[2]);
}

}  // namespace

PileUp::PileUp(std::size_t robots, bool cuts)
    : cuts_(cuts), crowd_(robots), size_(robots), pile_body_(robots), moved_(robots) {
  constexpr std::size_t most_touches = 200;
  touches_.reserve(most_touches);
}

void PileUp::note(std::size_t a, std::optional<std::size_t> b, const dContactGeom& geom, Pair pair) {
  touches_.push_back({.a = a, .b = b, .geom = geom, .pair = pair, .through_ball_m_s = {}});
}

void PileUp::note_through_ball(std::size_t a, std::optional<std::size_t> b, const dContactGeom& geom,
                               double approach_m_s) {
  touches_.push_back(
      {.a = a, .b = b, .geom = geom, .pair = Pair::held_body_ball, .through_ball_m_s = approach_m_s});
}

std::size_t PileUp::crowd_of(std::size_t robot) const {
  while (crowd_[robot] != robot) {
    robot = crowd_[robot];
  }
  return robot;
}

void PileUp::find_crowds() {
  std::iota(crowd_.begin(), crowd_.end(), std::size_t{0});
  std::ranges::fill(size_, 1);
  for (const Touch& touch : touches_) {
    if (!touch.b || !is_level(touch.geom)) {
      continue;
    }
    const std::size_t a = crowd_of(touch.a);
    const std::size_t b = crowd_of(*touch.b);
    if (a != b) {
      crowd_[b] = a;
      size_[a] += size_[b];
    }
  }
}

bool PileUp::in_model(const Touch& touch) const {
  return is_level(touch.geom) && pile_body_[touch.a] && (!touch.b || pile_body_[*touch.b]);
}

bool PileUp::is_cut(const Touch& touch) const {
  return in_model(touch) && !touch.through_ball_m_s && moved_[touch.a] && (!touch.b || moved_[*touch.b]);
}

void PileUp::add_robots(std::span<const Robot> robots) {
  pile_.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    pile_body_[i].reset();
    moved_[i] = false;
    if (cuts_ && robots[i].on_field && size_[crowd_of(i)] > largest_exact) {
      pile_body_[i] = pile_.add(planar(robots[i]));
      moved_[i] = is_standing(robots[i]);
    }
  }
}

void PileUp::add_contact(const Touch& touch, const dSurfaceParameters& surface) {
  PlanarContact contact = planar(touch.geom, surface);
  contact.a = *pile_body_[touch.a];
  if (touch.b) {
    contact.b = pile_body_[*touch.b];
  }
  if (touch.through_ball_m_s) {
    contact.friction = 0.0;
    contact.part_m_s = -*touch.through_ball_m_s;
  }
  pile_.add(contact);
}

void PileUp::act(std::span<const Robot> robots, Contacts& contacts, double step_s) {
  find_crowds();
  add_robots(robots);
  for (const Touch& touch : touches_) {
    if (in_model(touch)) {
      add_contact(touch, contacts.surface_of(touch.pair));
    }
    if (!is_cut(touch) && !touch.through_ball_m_s) {
      contacts.join_at(touch.geom, touch.pair);
    }
  }
  pile_.solve(step_s);
  push_apart(robots, step_s);
  touches_.clear();
}

void PileUp::push_apart(std::span<const Robot> robots, double step_s) const {
  std::size_t contact = 0;
  for (const Touch& touch : touches_) {
    if (!in_model(touch)) {
      continue;
    }
    const Vec2 impulse_Ns = pile_.impulse_Ns(contact++);
    if (!is_cut(touch)) {
      continue;
    }
    push(robots[touch.a], touch.geom, impulse_Ns, 1.0 / step_s);
    if (touch.b) {
      push(robots[*touch.b], touch.geom, impulse_Ns, -1.0 / step_s);
    }
  }
}

void PileUp::settle(std::span<const Robot> robots, double step_s) const {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (moved_[i]) {
      move_instead(robots[i], kept_in_step(step_s) * pile_.speeds_after(*pile_body_[i]), step_s);
    }
  }
}

}  // namespace striker::sil

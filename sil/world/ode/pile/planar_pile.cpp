// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/pile/planar_pile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

constexpr int sweeps = 30;  // each there and back

// The line of action of a force along `direction` at a lever from the centre.
Vec3 line_of(Vec2 lever_m, Vec2 direction) {
  return {direction.x, direction.y, lever_m.x * direction.y - lever_m.y * direction.x};
}

}  // namespace

PlanarPile::PlanarPile() {
  constexpr std::size_t robots = 10;
  constexpr std::size_t most_contacts = 200;  // every pair with two, every robot at two walls
  bodies_.reserve(robots);
  contacts_.reserve(most_contacts);
  rows_.reserve(3 * robots + 2 * most_contacts);
}

void PlanarPile::clear() {
  bodies_.clear();
  contacts_.clear();
  rows_.clear();
}

std::size_t PlanarPile::add(const PileRobot& robot) {
  bodies_.push_back(
      {.robot = robot, .speeds = {robot.velocity_m_s.x, robot.velocity_m_s.y, robot.yaw_rate_rad_s}});
  return bodies_.size() - 1;
}

void PlanarPile::add(const PlanarContact& contact) {
  contacts_.push_back(contact);
}

Vec3 PlanarPile::yield(std::size_t body, const Vec3& line) const {
  const PileRobot& robot = bodies_[body].robot;
  const double cosine = std::cos(robot.pose.heading_rad);
  const double sine = std::sin(robot.pose.heading_rad);
  const double along = (cosine * line.x + sine * line.y) / robot.mass_along_kg;
  const double across = (cosine * line.y - sine * line.x) / robot.mass_across_kg;
  return {cosine * along - sine * across, sine * along + cosine * across, line.z / robot.inertia_kg_m2};
}

double PlanarPile::speed_along(const Row& row) const {
  return dot(row.line_a, bodies_[row.a].speeds) + (row.b ? dot(row.line_b, bodies_[*row.b].speeds) : 0.0);
}

void PlanarPile::add_row(std::size_t a, std::optional<std::size_t> b, Vec2 at_m, Vec2 direction, Row row) {
  const auto lever = [this, at_m](std::size_t body) {
    const Pose& pose = bodies_[body].robot.pose;
    return Vec2{at_m.x - pose.x_m, at_m.y - pose.y_m};
  };
  row.a = a;
  row.b = b;
  row.line_a = line_of(lever(a), direction);
  row.yield_a = yield(a, row.line_a);
  double yields = dot(row.line_a, row.yield_a);
  if (b) {
    row.line_b = line_of(lever(*b), {-direction.x, -direction.y});
    row.yield_b = yield(*b, row.line_b);
    yields += dot(row.line_b, row.yield_b);
  }
  row.mass_kg = 1.0 / yields;
  rows_.push_back(row);
}

void PlanarPile::add_traction(std::size_t body, double step_s) {
  const PileRobot robot = bodies_[body].robot;
  const Vec2 ahead{std::cos(robot.pose.heading_rad), std::sin(robot.pose.heading_rad)};
  const Vec2 left{-ahead.y, ahead.x};
  const Vec2 centre{robot.pose.x_m, robot.pose.y_m};
  double side_m = robot.half_axle_m;
  for (const PlanarDrive& drive : robot.drives) {
    const Vec2 wheel{centre.x + side_m * left.x, centre.y + side_m * left.y};
    add_row(body, {}, wheel, ahead, {.speed_m_s = drive.rim_speed_m_s, .limit_Ns = drive.force_N * step_s});
    side_m = -side_m;
  }
  add_row(body, {}, centre, left, {.speed_m_s = 0.0, .limit_Ns = robot.grip_N * step_s});
}

void PlanarPile::add_contact_rows(const PlanarContact& contact) {
  add_row(contact.a, contact.b, contact.at_m, contact.normal, {.pushes_only = true});
  Row& push = rows_.back();
  const double closing_m_s = -speed_along(push);
  const bool bounces = contact.bounce > 0.0 && closing_m_s > bounce_threshold_m_s;
  push.speed_m_s = bounces ? std::max(contact.bounce * closing_m_s, contact.part_m_s) : contact.part_m_s;
  const std::size_t pushing = rows_.size() - 1;
  add_row(contact.a, contact.b, contact.at_m, {-contact.normal.y, contact.normal.x},
          {.limit_Ns = contact.friction, .grips = pushing});
}

void PlanarPile::relax(Row& row) {
  const double wanted = row.impulse_Ns + row.mass_kg * (row.speed_m_s - speed_along(row));
  const double limit_Ns = row.grips ? row.limit_Ns * rows_[*row.grips].impulse_Ns : row.limit_Ns;
  const double impulse_Ns = row.pushes_only ? std::max(wanted, 0.0) : std::clamp(wanted, -limit_Ns, limit_Ns);
  const double change_Ns = impulse_Ns - row.impulse_Ns;
  row.impulse_Ns = impulse_Ns;
  bodies_[row.a].speeds = bodies_[row.a].speeds + change_Ns * row.yield_a;
  if (row.b) {
    bodies_[*row.b].speeds = bodies_[*row.b].speeds + change_Ns * row.yield_b;
  }
}

void PlanarPile::solve(double step_s) {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    add_traction(body, step_s);
  }
  first_contact_row_ = rows_.size();
  for (const PlanarContact& contact : contacts_) {
    add_contact_rows(contact);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Row& row : rows_) {
      relax(row);
    }
    for (auto row = rows_.rbegin(); row != rows_.rend(); ++row) {
      relax(*row);
    }
  }
}

Vec2 PlanarPile::impulse_Ns(std::size_t contact) const {
  const Vec2 normal = contacts_[contact].normal;
  const double push_Ns = rows_[first_contact_row_ + 2 * contact].impulse_Ns;
  const double rub_Ns = rows_[first_contact_row_ + 2 * contact + 1].impulse_Ns;
  return {push_Ns * normal.x - rub_Ns * normal.y, push_Ns * normal.y + rub_Ns * normal.x};
}

}  // namespace striker::sil

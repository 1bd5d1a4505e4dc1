// SPDX-License-Identifier: Apache-2.0
#include "sil/world/world.hpp"

#include <stdexcept>
#include <utility>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/field.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/ode/robot.hpp"

namespace striker::sil {
namespace {

constexpr std::size_t max_robots = 10;

double distance_squared(dBodyID a, dBodyID b) {
  const dReal* p = dBodyGetPosition(a);
  const dReal* q = dBodyGetPosition(b);
  return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

}  // namespace

// The geometry is tested pair by pair in a fixed order, not through an ODE space, whose order depends on
// history.
struct World::Impl {
  explicit Impl(const WorldConfig& config);

  void collide_robot(Robot& robot);
  void collide_ball();
  void collide_ball_with(Robot& robot);
  void step();

  double step_s;
  bool has_walls;
  OdeWorld world;
  Contacts contacts;
  Field field;
  std::vector<Robot> robots;
  Ball ball;
};

World::Impl::Impl(const WorldConfig& config)
    : step_s(config.step_s),
      has_walls(config.walls),
      world(config.step_s),
      contacts(world.get(), config.step_s),
      field(make_field(config.walls)),
      ball(make_ball(world.get(), config.ball_kept_after_1_s, config.step_s)) {
  for (const RobotSpec& spec : config.robots) {
    robots.push_back(make_robot(world.get(), spec));
  }
}

void World::Impl::collide_robot(Robot& robot) {
  for (const GeomHandle& tyre : robot.tyres) {
    contacts.collide(tyre.get(), field.floor.get(), Pair::floor_wheel, tyre_friction_axis(robot),
                     robot.spec.tyre_friction);
  }
  for (const GeomHandle& skid : robot.skids) {
    contacts.collide(skid.get(), field.floor.get(), Pair::floor_body);
  }
  contacts.collide(robot.box.get(), field.floor.get(), Pair::floor_body);
  const dReal* position = dBodyGetPosition(robot.body);
  if (has_walls && near_wall(position[0], position[1], robot_reach_m)) {
    for (const GeomHandle& wall : field.walls) {
      contacts.collide(robot.box.get(), wall.get(), Pair::wall_body);
    }
  }
  if (has_walls && position[2] + robot_reach_m > robot_ceiling_m) {
    contacts.collide(robot.box.get(), field.robot_ceiling.get(), Pair::wall_body);
  }
}

void World::Impl::collide_ball() {
  contacts.collide(ball.geom.get(), field.floor.get(), Pair::floor_ball, ball_friction_axis(ball));
  const dReal* position = dBodyGetPosition(ball.body);
  if (has_walls && near_wall(position[0], position[1], ball_radius_m)) {
    for (const GeomHandle& wall : field.walls) {
      contacts.collide(ball.geom.get(), wall.get(), Pair::wall_ball);
    }
  }
  if (has_walls && position[2] + ball_radius_m > ball_ceiling_m) {
    contacts.collide(ball.geom.get(), field.ball_ceiling.get(), Pair::wall_ball);
  }
}

void World::Impl::collide_ball_with(Robot& robot) {
  constexpr double reach_m = robot_reach_m + ball_radius_m;
  robot.ball_contact.reset();
  if (distance_squared(robot.body, ball.body) > reach_m * reach_m) {
    return;
  }
  const Pair pair = robot.spec.role == Role::goalkeeper ? Pair::goalkeeper_ball : Pair::body_ball;
  const auto met = contacts.collide(robot.box.get(), ball.geom.get(), pair);
  if (!met.empty()) {
    robot.ball_contact = contact_direction(met.front(), robot.body, ball.body);
  }
}

void World::Impl::step() {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    collide_robot(robots[i]);
    collide_ball_with(robots[i]);
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      if (distance_squared(robots[i].body, robots[j].body) < 4.0 * robot_reach_m * robot_reach_m) {
        contacts.collide(robots[i].box.get(), robots[j].box.get(), Pair::body_body);
      }
    }
    apply_torques(robots[i]);
  }
  collide_ball();
  dWorldStep(world.get(), step_s);
  contacts.clear();
}

World::World(const WorldConfig& config) {
  if (config.robots.empty() || config.robots.size() > max_robots) {
    throw std::invalid_argument("WorldConfig.robots: a world holds 1 to 10 robots");
  }
  if (!(config.step_s > 0.0)) {
    throw std::invalid_argument("WorldConfig.step_s: must be greater than 0");
  }
  impl_ = std::make_unique<Impl>(config);
  // Apart from each other, until the owner places them.
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    place_robot(i, {.x_m = -3.0, .y_m = -1.8 + 0.4 * static_cast<double>(i), .heading_rad = 0.0});
  }
  place_ball({});
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::place_robot(std::size_t robot, const Pose& pose) {
  place(impl_->robots.at(robot), pose);
}

void World::place_ball(const BallState& ball) {
  place(impl_->ball, ball);
}

void World::servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm) {
  set_servo(impl_->robots.at(robot), wheel, rim_speed_m_s, torque_ceiling_Nm);
}

void World::torque_wheel(std::size_t robot, Wheel wheel, double torque_Nm) {
  set_torque(impl_->robots.at(robot), wheel, torque_Nm);
}

void World::step() {
  impl_->step();
}

std::optional<Vec2> World::ball_contact(std::size_t robot) const {
  return impl_->robots.at(robot).ball_contact;
}

Pose World::robot_pose(std::size_t robot) const {
  const Robot& placed = impl_->robots.at(robot);
  const dReal* position = dBodyGetPosition(placed.body);
  return {.x_m = position[0], .y_m = position[1], .heading_rad = heading_rad(placed)};
}

Vec2 World::robot_velocity_m_s(std::size_t robot) const {
  const dReal* velocity = dBodyGetLinearVel(impl_->robots.at(robot).body);
  return {velocity[0], velocity[1]};
}

double World::rim_speed_m_s(std::size_t robot, Wheel wheel) const {
  return sil::rim_speed_m_s(impl_->robots.at(robot), wheel);
}

BallState World::ball() const {
  return state_of(impl_->ball);
}

double World::step_s() const {
  return impl_->step_s;
}

}  // namespace striker::sil

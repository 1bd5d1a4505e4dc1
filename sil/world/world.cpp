// SPDX-License-Identifier: Apache-2.0
#include "sil/world/world.hpp"

#include <stdexcept>
#include <utility>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/ball/flight.hpp"
#include "sil/world/ode/ball/held.hpp"
#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/field.hpp"
#include "sil/world/ode/materials.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/ode/pile/pile_up.hpp"
#include "sil/world/ode/robot.hpp"
#include "sil/world/ode/state_hash.hpp"

namespace striker::sil {
namespace {

constexpr std::size_t max_robots = 10;

// Where a ball can be held: how fast, at most, depth in a robot pushes it out. A free ball has 0.1 mJ of it, and a
// robot of 1.7 kg that pushes itself off a held one 0.8 mJ. A bounce is not limited by it.
constexpr double push_out_m_s = 0.1;
constexpr double push_out_held_m_s = 0.03;

}  // namespace

// The geometry is tested pair by pair in a fixed order, not through an ODE space, whose order depends on
// history.
struct World::Impl {
  explicit Impl(const WorldConfig& config);

  void collide_robot(std::size_t which);
  void collide_robots(std::size_t a, std::size_t b);
  void collide_ball();
  void collide_ball_with(Robot& robot);
  void step();

  double step_s;
  bool has_walls;
  bool can_be_held;
  bool held = false;  // in this step
  OdeWorld world;
  Contacts contacts;
  Field field;
  std::vector<Robot> robots;
  PileUp pile_up;
  Ball ball;
};

World::Impl::Impl(const WorldConfig& config)
    : step_s(config.step_s),
      has_walls(config.walls),
      can_be_held(config.ball_can_be_held),
      world(config.step_s),
      contacts(world.get(), config.step_s),
      field(make_field(config.walls)),
      pile_up(config.robots.size(), config.crowds_are_cut),
      ball(make_ball(world.get(), config.ball_kept_after_1_s, config.step_s)) {
  for (const RobotSpec& spec : config.robots) {
    robots.push_back(make_robot(world.get(), spec));
  }
}

void World::Impl::collide_robot(std::size_t which) {
  const Robot& robot = robots[which];
  for (const GeomHandle& tyre : robot.tyres) {
    contacts.collide(tyre.get(), field.floor.get(), Pair::floor_wheel,
                     {.friction_axis = tyre_friction_axis(robot), .friction = robot.spec.tyre_friction});
  }
  for (const GeomHandle& skid : robot.skids) {
    contacts.collide(skid.get(), field.floor.get(), Pair::floor_body);
  }
  contacts.collide(robot.box.get(), field.floor.get(), Pair::floor_body);
  const dReal* position = dBodyGetPosition(robot.body);
  if (has_walls && near_wall(position[0], position[1], robot_reach_m)) {
    for (const GeomHandle& wall : field.walls) {
      for (const dContactGeom& met : contacts.find_boxes(robot.box.get(), wall.get())) {
        pile_up.note(which, {}, met, Pair::wall_body);
      }
    }
  }
  if (has_walls && position[2] + robot_reach_m > robot_ceiling_m) {
    contacts.collide(robot.box.get(), field.robot_ceiling.get(), Pair::wall_body);
  }
}

void World::Impl::collide_robots(std::size_t a, std::size_t b) {
  if (!may_touch(robots[a], robots[b])) {
    return;
  }
  for (const dContactGeom& met : contacts.find_boxes(robots[a].box.get(), robots[b].box.get())) {
    pile_up.note(a, b, met, Pair::body_body);
  }
}

void World::Impl::collide_ball() {
  contacts.collide(ball.geom.get(), field.floor.get(), Pair::floor_ball,
                   {.friction_axis = ball_friction_axis(ball)});
  if (held && has_walls) {
    join_held_ball_to_walls(ball, contacts, step_s);
  }
  if (held) {
    note_pushes_through(ball, robots, has_walls, step_s, pile_up);
  }
}

void World::Impl::collide_ball_with(Robot& robot) {
  if (!may_touch(robot, ball)) {
    return;
  }
  const Pair table = robot.spec.role == Role::goalkeeper ? Pair::goalkeeper_ball : Pair::body_ball;
  SpecialContact special;
  if (can_be_held) {
    special.correction_m_s = held ? push_out_held_m_s : push_out_m_s;
  }
  const auto met =
      contacts.collide(robot.box.get(), ball.geom.get(), held ? Pair::held_body_ball : table, special);
  if (!met.empty()) {
    robot.ball_contact = contact_direction(met.front(), robot.body, ball.body);
    robot.touched_ball = true;
  }
}

void World::Impl::step() {
  held = can_be_held && is_held(ball, robots, has_walls, step_s);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].ball_contact.reset();
    if (!robots[i].on_field) {
      continue;
    }
    collide_robot(i);
    collide_ball_with(robots[i]);
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      collide_robots(i, j);
    }
    apply_torques(robots[i]);
  }
  collide_ball();
  pile_up.act(robots, contacts, step_s);
  const Vec3 ball_was_m = motion_of(ball).position_m;
  dWorldStep(world.get(), step_s);
  contacts.clear();
  pile_up.settle(robots, step_s);
  if (has_walls) {
    bounce_off_walls(ball, ball_was_m, step_s, held ? Bounce::none : Bounce::table);
  }
  if (has_walls || can_be_held) {
    keep_above_floor(ball);
  }
}

WorldConfig match_world(double step_s) {
  WorldConfig config{.robots = {}, .step_s = step_s, .ball_can_be_held = true, .crowds_are_cut = true};
  for (int team = 0; team < 2; ++team) {
    for (const Role role : {Role::goalkeeper, Role::defender, Role::defender, Role::forward, Role::forward}) {
      config.robots.push_back(robot_spec(role));
    }
  }
  return config;
}

World::World(const WorldConfig& config) {
  if (config.robots.empty() || config.robots.size() > max_robots) {
    throw std::invalid_argument("WorldConfig.robots: a world holds 1 to 10 robots");
  }
  if (!(config.step_s > 0.0)) {
    throw std::invalid_argument("WorldConfig.step_s: must be greater than 0");
  }
  impl_ = std::make_unique<Impl>(config);
  if (config.robots.size() > 1) {
    // Four robots in one exact crowd, the ball between them: more have not been seen where crowds are cut.
    constexpr std::size_t rows = 250;
    constexpr int contacts = 300;
    impl_->world.reserve(rows);
    impl_->contacts.reserve(contacts);
  }
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

void World::remove_robot(std::size_t robot, const Pose& to) {
  remove(impl_->robots.at(robot), to);
}

bool World::is_removed(std::size_t robot) const {
  return !impl_->robots.at(robot).on_field;
}

void World::place_ball(const BallState& ball) {
  place(impl_->ball, ball);
}

void World::drop_ball(Vec2 position_m, double height_m) {
  drop(impl_->ball, position_m, height_m);
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

bool World::touched_ball(std::size_t robot) const {
  return impl_->robots.at(robot).touched_ball;
}

void World::clear_touches() {
  for (Robot& robot : impl_->robots) {
    robot.touched_ball = false;
  }
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

double World::yaw_rate_rad_s(std::size_t robot) const {
  return dBodyGetAngularVel(impl_->robots.at(robot).body)[2];
}

double World::robot_height_m(std::size_t robot) const {
  return dBodyGetPosition(impl_->robots.at(robot).body)[2];
}

double World::robot_up(std::size_t robot) const {
  constexpr std::size_t up_z = 10;  // row z, column z of ODE's rows of four
  return dBodyGetRotation(impl_->robots.at(robot).body)[up_z];
}

double World::rim_speed_m_s(std::size_t robot, Wheel wheel) const {
  return sil::rim_speed_m_s(impl_->robots.at(robot), wheel);
}

BallState World::ball() const {
  return state_of(impl_->ball);
}

BallInSpace World::ball_in_space() const {
  const dReal* position = dBodyGetPosition(impl_->ball.body);
  const dReal* velocity = dBodyGetLinearVel(impl_->ball.body);
  return {.position_m = {position[0], position[1], position[2]},
          .velocity_m_s = {velocity[0], velocity[1], velocity[2]}};
}

double World::step_s() const {
  return impl_->step_s;
}

std::uint64_t World::state_hash() const {
  return sil::state_hash(impl_->robots, impl_->ball);
}

}  // namespace striker::sil

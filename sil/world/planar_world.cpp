// SPDX-License-Identifier: Apache-2.0
#include "sil/world/planar_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/field.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/planar_robot.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

constexpr double box_height_m = robot_top_m - robot_bottom_m;

// Robot and ball in ODE, for the time after the first contact.
class Collision {
 public:
  Collision(const WorldConfig& config, const PlanarModel& model);

  void begin(const PlanarRobot& robot, const BallState& ball);
  // The contact's normal, if the robot's body met the ball.
  std::optional<Vec2> step(const WheelServos& servos);
  void read(PlanarRobot& robot, BallState& ball) const;

 private:
  void roll(const WheelServo& servo, double side_m);

  PlanarModel model_;
  double step_s_;
  OdeWorld world_;
  Contacts contacts_;
  JointGroupHandle wheels_;
  Field field_;
  dBodyID robot_;
  GeomHandle box_;
  Ball ball_;
  dSurfaceParameters tyre_;
};

Collision::Collision(const WorldConfig& config, const PlanarModel& model)
    : model_(model),
      step_s_(config.step_s),
      world_(config.step_s),
      contacts_(world_.get(), config.step_s),
      wheels_(dJointGroupCreate(0)),
      field_(make_field(false)),
      robot_(dBodyCreate(world_.get())),
      box_(dCreateBox(nullptr, robot_side_m, robot_side_m, box_height_m)),
      ball_(make_ball(world_.get(), config.ball_kept_after_1_s, config.step_s)),
      tyre_(surface(Pair::floor_wheel, config.step_s)) {
  // So much inertia that nothing tilts it.
  constexpr double upright_kgm2 = 1e3;
  dMass mass;
  dMassSetParameters(&mass, model.mass_kg, 0.0, 0.0, 0.0, upright_kgm2, upright_kgm2, model.inertia_kgm2, 0.0,
                     0.0, 0.0);
  dBodySetMass(robot_, &mass);
  dBodySetGyroscopicMode(robot_, 0);
  dGeomSetBody(box_.get(), robot_);
  dGeomSetOffsetPosition(box_.get(), 0.0, 0.0,
                         0.5 * (robot_bottom_m + robot_top_m) - centre_of_mass_height_m);
  tyre_.mode =
      dContactFDir1 | dContactMotion1 | dContactSoftERP | dContactSoftCFM | dContactApprox1_2 | dContactMu2;
  tyre_.mu2 = tyre_.mu;
}

void Collision::begin(const PlanarRobot& robot, const BallState& ball) {
  const double half_rad = 0.5 * robot.pose.heading_rad;
  const dQuaternion turned = {std::cos(half_rad), 0.0, 0.0, std::sin(half_rad)};
  dBodySetPosition(robot_, robot.pose.x_m, robot.pose.y_m, centre_of_mass_height_m);
  dBodySetQuaternion(robot_, turned);
  dBodySetLinearVel(robot_, robot.velocity_m_s.x, robot.velocity_m_s.y, 0.0);
  dBodySetAngularVel(robot_, 0.0, 0.0, robot.yaw_rate_rad_s);
  place(ball_, ball);
}

// A wheel: it carries the robot, drives along the heading, and holds it across.
void Collision::roll(const WheelServo& servo, double side_m) {
  dContact contact{};
  contact.surface = tyre_;
  contact.surface.mu = rim_force_limit_N(model_, servo);
  contact.surface.motion1 = servo.rim_speed_m_s;
  const dReal* rotation = dBodyGetRotation(robot_);
  const dReal* position = dBodyGetPosition(robot_);
  contact.fdir1[0] = rotation[0];
  contact.fdir1[1] = rotation[4];
  contact.geom.pos[0] = position[0] - rotation[4] * side_m;
  contact.geom.pos[1] = position[1] + rotation[0] * side_m;
  contact.geom.normal[2] = 1.0;
  contact.geom.depth = centre_of_mass_height_m - position[2];
  dJointAttach(dJointCreateContact(world_.get(), wheels_.get(), &contact), robot_, nullptr);
}

std::optional<Vec2> Collision::step(const WheelServos& servos) {
  std::optional<Vec2> normal;
  const auto met = contacts_.collide(box_.get(), ball_.geom.get(), Pair::body_ball);
  if (!met.empty()) {
    normal = contact_direction(met.front(), robot_, ball_.body);
  }
  contacts_.collide(ball_.geom.get(), field_.floor.get(), Pair::floor_ball, ball_friction_axis(ball_));
  roll(servos[0], model_.half_axle_m);
  roll(servos[1], -model_.half_axle_m);
  dWorldStep(world_.get(), step_s_);
  contacts_.clear();
  dJointGroupEmpty(wheels_.get());
  return normal;
}

void Collision::read(PlanarRobot& robot, BallState& ball) const {
  const dReal* position = dBodyGetPosition(robot_);
  const dReal* rotation = dBodyGetRotation(robot_);
  const dReal* velocity = dBodyGetLinearVel(robot_);
  robot.heading = {rotation[0], rotation[4]};
  robot.pose = {.x_m = position[0], .y_m = position[1], .heading_rad = std::atan2(rotation[4], rotation[0])};
  robot.velocity_m_s = {velocity[0], velocity[1]};
  robot.yaw_rate_rad_s = dBodyGetAngularVel(robot_)[2];
  ball = state_of(ball_);
}

// The sphere's centre is always between the box's floor and roof: the plane decides.
bool meet(const PlanarRobot& robot, Vec2 ball_m) {
  constexpr double half_side_m = 0.5 * robot_side_m;
  const Vec2 line{ball_m.x - robot.pose.x_m, ball_m.y - robot.pose.y_m};
  const double along = std::abs(line.x * robot.heading.x + line.y * robot.heading.y);
  const double across = std::abs(line.y * robot.heading.x - line.x * robot.heading.y);
  const double ahead = std::max(along - half_side_m, 0.0);
  const double beside = std::max(across - half_side_m, 0.0);
  return ahead * ahead + beside * beside <= ball_radius_m * ball_radius_m;
}

void require_robot_0(std::size_t robot) {
  if (robot != 0) {
    throw std::out_of_range("PlanarWorld: holds robot 0 only");
  }
}

}  // namespace

struct PlanarWorld::Impl {
  explicit Impl(const WorldConfig& config)
      : step_s(config.step_s),
        kept(kept_in_step(config.step_s)),
        ball_kept(kept_in_step(config.step_s, config.ball_kept_after_1_s)),
        model(planar_model(config.robots.front())),
        collision(config, model) {}

  double step_s;
  double kept;
  double ball_kept;
  PlanarModel model;
  PlanarRobot robot;
  WheelServos servos{};
  BallState ball;
  std::optional<Vec2> normal;
  bool touched = false;  // robot and ball have met: ODE has both
  Collision collision;
};

PlanarWorld::PlanarWorld(double step_s) : PlanarWorld(WorldConfig{.walls = false, .step_s = step_s}) {}

PlanarWorld::PlanarWorld(const WorldConfig& config) {
  if (config.robots.size() != 1 || config.walls) {
    throw std::invalid_argument("PlanarWorld: holds one robot on an open floor");
  }
  if (!(config.step_s > 0.0)) {
    throw std::invalid_argument("PlanarWorld: step_s must be greater than 0");
  }
  impl_ = std::make_unique<Impl>(config);
}

PlanarWorld::~PlanarWorld() = default;
PlanarWorld::PlanarWorld(PlanarWorld&&) noexcept = default;
PlanarWorld& PlanarWorld::operator=(PlanarWorld&&) noexcept = default;

void PlanarWorld::place_robot(std::size_t robot, const Pose& pose) {
  require_robot_0(robot);
  impl_->robot = planar_robot(pose);
  impl_->servos = {};
  impl_->normal.reset();
  impl_->touched = false;
}

void PlanarWorld::place_ball(const BallState& ball) {
  impl_->ball = ball;
  impl_->touched = false;
}

void PlanarWorld::servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s,
                              double torque_ceiling_Nm) {
  require_robot_0(robot);
  impl_->servos[static_cast<std::size_t>(wheel)] = {.rim_speed_m_s = rim_speed_m_s,
                                                    .torque_ceiling_Nm = torque_ceiling_Nm};
}

void PlanarWorld::step() {
  Impl& world = *impl_;
  if (!world.touched && meet(world.robot, world.ball.position_m)) {
    world.touched = true;
    world.collision.begin(world.robot, world.ball);
  }
  if (world.touched) {
    world.normal = world.collision.step(world.servos);
    world.collision.read(world.robot, world.ball);
    return;
  }
  sil::step(world.robot, world.model, world.servos, world.step_s, world.kept);
  auto& [position, velocity] = world.ball;
  position = {position.x + world.step_s * velocity.x, position.y + world.step_s * velocity.y};
  velocity = {world.ball_kept * velocity.x, world.ball_kept * velocity.y};
}

std::optional<Vec2> PlanarWorld::ball_contact(std::size_t robot) const {
  require_robot_0(robot);
  return impl_->normal;
}

Pose PlanarWorld::robot_pose(std::size_t robot) const {
  require_robot_0(robot);
  return impl_->robot.pose;
}

Vec2 PlanarWorld::robot_velocity_m_s(std::size_t robot) const {
  require_robot_0(robot);
  return impl_->robot.velocity_m_s;
}

double PlanarWorld::rim_speed_m_s(std::size_t robot, Wheel wheel) const {
  require_robot_0(robot);
  return sil::rim_speed_m_s(impl_->robot, impl_->model, wheel);
}

BallState PlanarWorld::ball() const {
  return impl_->ball;
}

double PlanarWorld::step_s() const {
  return impl_->step_s;
}

}  // namespace striker::sil

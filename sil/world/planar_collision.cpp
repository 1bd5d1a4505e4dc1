// SPDX-License-Identifier: Apache-2.0
#include "sil/world/planar_collision.hpp"

#include <cmath>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/contacts.hpp"
#include "sil/world/ode/field.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

constexpr double box_height_m = robot_top_m - robot_bottom_m;

}  // namespace

struct PlanarCollision::Impl {
  Impl(const WorldConfig& config, const PlanarModel& model);

  void become(const PlanarModel& model, double ball_kept_after_1_s);
  void begin(const PlanarRobot& robot, const BallState& ball);
  std::optional<Vec2> step(const WheelServos& servos);
  void step_ball();
  void read(PlanarRobot& robot, BallState& ball) const;

  void weigh();
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

PlanarCollision::Impl::Impl(const WorldConfig& config, const PlanarModel& model)
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
  weigh();
  dBodySetGyroscopicMode(robot_, 0);
  dGeomSetBody(box_.get(), robot_);
  dGeomSetOffsetPosition(box_.get(), 0.0, 0.0,
                         0.5 * (robot_bottom_m + robot_top_m) - centre_of_mass_height_m);
  tyre_.mode =
      dContactFDir1 | dContactMotion1 | dContactSoftERP | dContactSoftCFM | dContactApprox1_2 | dContactMu2;
  tyre_.mu2 = tyre_.mu;
}

void PlanarCollision::Impl::weigh() {
  // So much inertia that nothing tilts it.
  constexpr double upright_kgm2 = 1e3;
  dMass mass;
  dMassSetParameters(&mass, model_.mass_kg, 0.0, 0.0, 0.0, upright_kgm2, upright_kgm2, model_.inertia_kgm2,
                     0.0, 0.0, 0.0);
  dBodySetMass(robot_, &mass);
}

void PlanarCollision::Impl::become(const PlanarModel& model, double ball_kept_after_1_s) {
  model_ = model;
  weigh();
  const double lost = 1.0 - kept_in_step(step_s_, ball_kept_after_1_s);
  dBodySetLinearDamping(ball_.body, lost);
  dBodySetAngularDamping(ball_.body, lost);
}

void PlanarCollision::Impl::begin(const PlanarRobot& robot, const BallState& ball) {
  dBodyEnable(robot_);
  const double half_rad = 0.5 * robot.pose.heading_rad;
  const dQuaternion turned = {std::cos(half_rad), 0.0, 0.0, std::sin(half_rad)};
  dBodySetPosition(robot_, robot.pose.x_m, robot.pose.y_m, centre_of_mass_height_m);
  dBodySetQuaternion(robot_, turned);
  dBodySetLinearVel(robot_, robot.velocity_m_s.x, robot.velocity_m_s.y, 0.0);
  dBodySetAngularVel(robot_, 0.0, 0.0, robot.yaw_rate_rad_s);
  place(ball_, ball);
}

// A wheel: it carries the robot, drives along the heading, and holds it across.
void PlanarCollision::Impl::roll(const WheelServo& servo, double side_m) {
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

std::optional<Vec2> PlanarCollision::Impl::step(const WheelServos& servos) {
  std::optional<Vec2> normal;
  const auto met = contacts_.collide(box_.get(), ball_.geom.get(), Pair::body_ball);
  if (!met.empty()) {
    normal = contact_direction(met.front(), robot_, ball_.body);
  }
  contacts_.collide(ball_.geom.get(), field_.floor.get(), Pair::floor_ball,
                    {.friction_axis = ball_friction_axis(ball_)});
  roll(servos[0], model_.half_axle_m);
  roll(servos[1], -model_.half_axle_m);
  dWorldStep(world_.get(), step_s_);
  contacts_.clear();
  dJointGroupEmpty(wheels_.get());
  return normal;
}

void PlanarCollision::Impl::step_ball() {
  dBodyDisable(robot_);
  contacts_.collide(ball_.geom.get(), field_.floor.get(), Pair::floor_ball,
                    {.friction_axis = ball_friction_axis(ball_)});
  dWorldStep(world_.get(), step_s_);
  contacts_.clear();
}

void PlanarCollision::Impl::read(PlanarRobot& robot, BallState& ball) const {
  const dReal* position = dBodyGetPosition(robot_);
  const dReal* rotation = dBodyGetRotation(robot_);
  const dReal* velocity = dBodyGetLinearVel(robot_);
  robot.heading = {rotation[0], rotation[4]};
  robot.pose = {.x_m = position[0], .y_m = position[1], .heading_rad = std::atan2(rotation[4], rotation[0])};
  robot.velocity_m_s = {velocity[0], velocity[1]};
  robot.yaw_rate_rad_s = dBodyGetAngularVel(robot_)[2];
  ball = state_of(ball_);
}

PlanarCollision::PlanarCollision(const WorldConfig& config, const PlanarModel& model)
    : impl_(std::make_unique<Impl>(config, model)) {}

PlanarCollision::~PlanarCollision() = default;
PlanarCollision::PlanarCollision(PlanarCollision&&) noexcept = default;
PlanarCollision& PlanarCollision::operator=(PlanarCollision&&) noexcept = default;

void PlanarCollision::become(const PlanarModel& model, double ball_kept_after_1_s) {
  impl_->become(model, ball_kept_after_1_s);
}

void PlanarCollision::begin(const PlanarRobot& robot, const BallState& ball) {
  impl_->begin(robot, ball);
}

std::optional<Vec2> PlanarCollision::step(const WheelServos& servos) {
  return impl_->step(servos);
}

void PlanarCollision::step_ball() {
  impl_->step_ball();
}

void PlanarCollision::read(PlanarRobot& robot, BallState& ball) const {
  impl_->read(robot, ball);
}

}  // namespace striker::sil

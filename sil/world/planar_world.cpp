// SPDX-License-Identifier: Apache-2.0
#include "sil/world/planar_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/ode_world.hpp"
#include "sil/world/planar_collision.hpp"
#include "sil/world/planar_robot.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

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
  PlanarCollision collision;
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

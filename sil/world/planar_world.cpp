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

// Refuses what this world is not, before anything is made of it.
const WorldConfig& checked(const WorldConfig& config) {
  if (config.robots.size() != 1 || config.walls) {
    throw std::invalid_argument("PlanarWorld: holds one robot on an open floor");
  }
  if (!(config.step_s > 0.0)) {
    throw std::invalid_argument("PlanarWorld: step_s must be greater than 0");
  }
  return config;
}

}  // namespace

PlanarWorld::PlanarWorld(double step_s) : PlanarWorld(WorldConfig{.walls = false, .step_s = step_s}) {}

PlanarWorld::PlanarWorld(const WorldConfig& config)
    : step_s_(checked(config).step_s),
      kept_(kept_in_step(config.step_s)),
      ball_kept_(kept_in_step(config.step_s, config.ball_kept_after_1_s)),
      model_(planar_model(config.robots.front())),
      collision_(std::make_unique<PlanarCollision>(config, model_)) {}

PlanarWorld::~PlanarWorld() = default;
PlanarWorld::PlanarWorld(PlanarWorld&&) noexcept = default;
PlanarWorld& PlanarWorld::operator=(PlanarWorld&&) noexcept = default;

void PlanarWorld::place_robot(std::size_t robot, const Pose& pose) {
  require_robot_0(robot);
  robot_ = planar_robot(pose);
  servos_ = {};
  normal_.reset();
  touched_ = false;
}

void PlanarWorld::place_ball(const BallState& ball) {
  ball_ = ball;
  touched_ = false;
}

void PlanarWorld::servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s,
                              double torque_ceiling_Nm) {
  require_robot_0(robot);
  servos_[static_cast<std::size_t>(wheel)] = {.rim_speed_m_s = rim_speed_m_s,
                                              .torque_ceiling_Nm = torque_ceiling_Nm};
}

void PlanarWorld::step() {
  if (!touched_ && meet(robot_, ball_.position_m)) {
    touched_ = true;
    collision_->begin(robot_, ball_);
  }
  if (touched_) {
    normal_ = collision_->step(servos_);
    collision_->read(robot_, ball_);
    return;
  }
  sil::step(robot_, model_, servos_, step_s_, kept_);
  auto& [position, velocity] = ball_;
  position = {position.x + step_s_ * velocity.x, position.y + step_s_ * velocity.y};
  velocity = {ball_kept_ * velocity.x, ball_kept_ * velocity.y};
}

void PlanarWorld::refuse_robot() {
  throw std::out_of_range("PlanarWorld: holds robot 0 only");
}

}  // namespace striker::sil

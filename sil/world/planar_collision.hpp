// SPDX-License-Identifier: Apache-2.0
// Robot and ball of the fast world in ODE, for the time after they met: the robot one body, its wheels contact joints
// with the floor that drive at the set-point, the ball and its contacts those of the full world.
//
//   PlanarCollision collision(config, model);
//   collision.begin(robot, ball);            // as they are before the step that finds the contact
//   while (...) {
//     collision.step(servos);
//     collision.read(robot, ball);
//   }
//
// What comes of it depends on what it began with alone.
#pragma once

#include <memory>
#include <optional>

#include "sil/world/planar_robot.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

class PlanarCollision {
 public:
  // Of one robot on an open floor, with this model of it.
  PlanarCollision(const WorldConfig& config, const PlanarModel& model);
  ~PlanarCollision();
  PlanarCollision(PlanarCollision&&) noexcept;
  PlanarCollision& operator=(PlanarCollision&&) noexcept;

  // Another robot and ball from now on: as one that was made with them. To be called before `begin`.
  void become(const PlanarModel& model, double ball_kept_after_1_s);
  void begin(const PlanarRobot& robot, const BallState& ball);
  // The contact's normal, if the robot's body met the ball. About 5 us.
  std::optional<Vec2> step(const WheelServos& servos);
  // The ball goes on alone, a fifth of the work: the same for it where the robot does not touch it. The robot stays
  // where it is until the next `begin`.
  void step_ball();
  void read(PlanarRobot& robot, BallState& ball) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace striker::sil

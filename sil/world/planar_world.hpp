// SPDX-License-Identifier: Apache-2.0
// The fast world of the kick task: one robot on the plane (planar_robot.hpp), the ball, an open floor. It
// has the interface of sil::World as far as the task needs it, and takes its place in training.
//
// Until robot and ball first meet nothing interacts, and a step is closed: the ball rolls on without slip.
// A contact is the full world's: the body's box against the sphere, on the poses before the step. From the
// first contact until the next `place_` call ODE's exact stepper solves robot (one body) and ball with the
// full world's contact joints; wheels are contact joints with the floor that drive at the set-point.
//
// How near it is to the full wheel bodies, on 1,000 random action sequences of the kick task
// (tests/world/planar_world_test.cpp; median, 99 %, largest of all):
//   robot's position until the contact    0.014 mm   0.11 mm   0.16 mm
//   robot's speed until the contact       0.1 mm/s   0.2 mm/s  0.7 mm/s
//   reward of the contact                 0.0001     0.0007    0.0012
//   ball's speed 100 ms after it          0.7 mm/s   73 mm/s   98 mm/s
// and every contact in the same physics step, on the same face, with the same `kicked`. That holds for
// straight driving. A robot told to turn at up to 4 rad/s agrees within 5 %; in faster turns the full
// bodies slide sideways and this one does not. After a contact beside the middle the full robot's tyres, 4 mm
// wide, resist the turn a little and steer it while it accelerates; these turn freely.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "sil/world/planar_robot.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

class PlanarCollision;

class PlanarWorld {
 public:
  explicit PlanarWorld(double step_s = 0.010);  // a forward's
  // Of one robot on an open floor; other configurations are refused (std::invalid_argument).
  explicit PlanarWorld(const WorldConfig& config);
  ~PlanarWorld();
  PlanarWorld(PlanarWorld&&) noexcept;
  PlanarWorld& operator=(PlanarWorld&&) noexcept;

  // As in sil::World; the only robot is number 0.
  void place_robot(std::size_t robot, const Pose& pose);
  void place_ball(const BallState& ball);
  void servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm);
  void step();
  // Asked at every step of training: so they are inline.
  [[nodiscard]] std::optional<Vec2> ball_contact(std::size_t robot) const {
    require_robot_0(robot);
    return normal_;
  }
  [[nodiscard]] Pose robot_pose(std::size_t robot) const {
    require_robot_0(robot);
    return robot_.pose;
  }
  [[nodiscard]] Vec2 robot_velocity_m_s(std::size_t robot) const {
    require_robot_0(robot);
    return robot_.velocity_m_s;
  }
  [[nodiscard]] double rim_speed_m_s(std::size_t robot, Wheel wheel) const {
    require_robot_0(robot);
    return sil::rim_speed_m_s(robot_, model_, wheel);
  }
  [[nodiscard]] BallState ball() const { return ball_; }
  [[nodiscard]] double step_s() const { return step_s_; }

 private:
  static void require_robot_0(std::size_t robot) {
    if (robot != 0) {
      refuse_robot();
    }
  }
  [[noreturn]] static void refuse_robot();

  double step_s_;
  double kept_;
  double ball_kept_;
  PlanarModel model_;
  PlanarRobot robot_;
  WheelServos servos_{};
  BallState ball_;
  std::optional<Vec2> normal_;
  bool touched_ = false;  // robot and ball have met: ODE has both
  std::unique_ptr<PlanarCollision> collision_;
};

}  // namespace striker::sil

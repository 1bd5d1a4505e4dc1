// SPDX-License-Identifier: Apache-2.0
// The AI Soccer world in ODE: field, ball, and one to ten two-wheel robots, with full wheel bodies.
//
// Coordinates: x along the field towards the opponent's goal, y to the left, origin in the centre; headings
// are anticlockwise from +x. SI units. A World is made and used by one thread; many worlds may live in one
// process, and be stepped by different threads at once. The same sequence of calls gives the same bits,
// whatever the world did before it was placed.
//
// Constants: AI World Cup test_world, branch master 37312a93 (2019), unless a comment names another source.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sil/world/physics_constants.hpp"
#include "sil/world/pose.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

struct BallState {
  Vec2 position_m;
  Vec2 velocity_m_s;
};

enum class Wheel { left, right };
inline constexpr std::array wheels = {Wheel::left, Wheel::right};

struct WorldConfig {
  std::vector<RobotSpec> robots = {robot_spec(Role::forward)};  // one to ten
  bool walls = true;                                            // false: an open floor (the kick task)
  // Contact stiffness and damping are kept the same at any step. ODE moves a body straight on in a step: fast
  // turns strain the axles at 10 ms and come out slower (a forward told to turn at 36 rad/s turns at 18).
  double step_s = 0.010;
  double ball_kept_after_1_s = kept_after_1_s;  // the share of its speed that damping leaves the ball
};

class World {
 public:
  explicit World(const WorldConfig& config);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // At rest on the floor, wheels still; forgets everything the robot did before.
  void place_robot(std::size_t robot, const Pose& pose);
  // On the floor, rolling without slip.
  void place_ball(const BallState& ball);

  // How each wheel is driven in the coming steps; the last call holds. A servo holds the rim speed within a
  // torque ceiling (the paper's motor); a torque acts as it is.
  void servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm);
  void torque_wheel(std::size_t robot, Wheel wheel, double torque_Nm);

  // One physics step: collision test, exact stepper, damping. No allocation after the first steps.
  void step();

  // In the collision test of the last step, did the robot's body meet the ball? Then the contact's unit
  // normal in world axes, pointing from the robot to the ball.
  [[nodiscard]] std::optional<Vec2> ball_contact(std::size_t robot) const;

  [[nodiscard]] Pose robot_pose(std::size_t robot) const;
  [[nodiscard]] Vec2 robot_velocity_m_s(std::size_t robot) const;
  // Rim speed relative to the body, positive forward.
  [[nodiscard]] double rim_speed_m_s(std::size_t robot, Wheel wheel) const;
  [[nodiscard]] BallState ball() const;
  [[nodiscard]] double step_s() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace striker::sil

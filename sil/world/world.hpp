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
#include <cstdint>
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

// The ball's centre, z above the floor.
struct BallInSpace {
  Vec3 position_m;
  Vec3 velocity_m_s;
};

enum class Wheel { left, right };
inline constexpr std::array wheels = {Wheel::left, Wheel::right};

struct WorldConfig {
  std::vector<RobotSpec> robots = {robot_spec(Role::forward)};  // one to ten
  bool walls = true;                                            // false: an open floor (the kick task)
  // Contact stiffness and damping are kept the same at any step. ODE moves a body straight on in a step: fast
  // turns strain the axles at 10 ms and come out slower (a forward told to turn at 36 rad/s turns at 18).
  double step_s = 0.010;
  // A ball between robots, or between a robot and a wall, is held: its contacts resist but do not bounce, so that
  // their energy never rises. AI Soccer's table, which is what false means, lets such a ball throw robots.
  bool ball_can_be_held = false;
  // Three and more robots that press on each other take the forces between them from a planar model of the crowd
  // (ode/pile/pile_up.hpp); false: from ODE's exact solver, at the cube of the crowd's size in time.
  bool crowds_are_cut = false;
  double ball_kept_after_1_s = kept_after_1_s;  // the share of its speed that damping leaves the ball
};

// Walls, ten robots of AI Soccer (goalkeeper, two defenders, two forwards a team), and all that makes a match.
[[nodiscard]] WorldConfig match_world(double step_s);

class World {
 public:
  explicit World(const WorldConfig& config);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // At rest on the floor, wheels still; forgets everything the robot did before.
  void place_robot(std::size_t robot, const Pose& pose);
  // Off the field until place_robot puts it back: in nothing's way and not stepped. Its pose is `to` and it is
  // upright and at rest, so a place inside a wall will do.
  void remove_robot(std::size_t robot, const Pose& to);
  [[nodiscard]] bool is_removed(std::size_t robot) const;
  // On the floor, rolling without slip.
  void place_ball(const BallState& ball);
  // At rest, its centre at this height: it falls. Not lower than it lies on the floor.
  void drop_ball(Vec2 position_m, double height_m);

  // How each wheel is driven in the coming steps; the last call holds. A servo holds the rim speed within a
  // torque ceiling (the paper's motor); a torque acts as it is.
  void servo_wheel(std::size_t robot, Wheel wheel, double rim_speed_m_s, double torque_ceiling_Nm);
  void torque_wheel(std::size_t robot, Wheel wheel, double torque_Nm);

  // One physics step: collision test, exact stepper, damping. No allocation after the first steps.
  void step();

  // In the collision test of the last step, did the robot's body meet the ball? Then the contact's unit
  // normal in world axes, pointing from the robot to the ball.
  [[nodiscard]] std::optional<Vec2> ball_contact(std::size_t robot) const;

  // Did it since the last clear_touches? Placed or removed, a robot forgets.
  [[nodiscard]] bool touched_ball(std::size_t robot) const;
  void clear_touches();

  [[nodiscard]] Pose robot_pose(std::size_t robot) const;
  [[nodiscard]] Vec2 robot_velocity_m_s(std::size_t robot) const;
  // Anticlockwise about the vertical.
  [[nodiscard]] double yaw_rate_rad_s(std::size_t robot) const;
  // Of the body's centre of mass above the floor: `centre_of_mass_height_m` where it stands.
  [[nodiscard]] double robot_height_m(std::size_t robot) const;
  // The vertical share of the robot's up axis: 1 upright, 0 on a side, -1 on its roof. Tilted by an angle it is
  // the angle's cosine.
  [[nodiscard]] double robot_up(std::size_t robot) const;
  // Rim speed relative to the body, positive forward.
  [[nodiscard]] double rim_speed_m_s(std::size_t robot, Wheel wheel) const;
  [[nodiscard]] BallState ball() const;
  [[nodiscard]] BallInSpace ball_in_space() const;
  [[nodiscard]] double step_s() const;
  // FNV-1a, 64 bits, over the bits of every body's position, attitude and velocities, and who is removed. Two
  // worlds of one configuration that agree in it, and are driven alike from there, stay the same.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace striker::sil

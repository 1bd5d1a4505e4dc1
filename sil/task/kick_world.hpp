// SPDX-License-Identifier: Apache-2.0
// What the kick task asks of a world, so that one definition of the task serves every world there is.
// sil::World and sil::PlanarWorld fulfil it; kick_task.cpp is where each is named once.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>

#include "sil/world/world.hpp"

namespace striker::sil {

template <class W>
concept KickWorld = requires(W world, const W& seen, std::size_t robot, Wheel wheel, double number) {
  world.place_robot(robot, Pose{});
  world.place_ball(BallState{});
  world.servo_wheel(robot, wheel, number, number);  // rim speed in m/s, torque ceiling in N m
  world.step();
  { seen.ball_contact(robot) } -> std::same_as<std::optional<Vec2>>;  // in the last step's collision test
  { seen.robot_pose(robot) } -> std::same_as<Pose>;
  { seen.robot_velocity_m_s(robot) } -> std::same_as<Vec2>;
  { seen.rim_speed_m_s(robot, wheel) } -> std::same_as<double>;
  { seen.ball() } -> std::same_as<BallState>;
  { seen.step_s() } -> std::same_as<double>;
};

}  // namespace striker::sil

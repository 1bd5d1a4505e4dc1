// SPDX-License-Identifier: Apache-2.0
// Small helpers: drive a robot, run a world, play a kick episode with given actions.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sil/task/kick_task.hpp"
#include "sil/world/random.hpp"
#include "sil/world/robot_specs.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

template <typename AnyWorld>
void drive(AnyWorld& world, std::size_t robot, double left_m_s, double right_m_s, double ceiling_Nm) {
  world.servo_wheel(robot, Wheel::left, left_m_s, ceiling_Nm);
  world.servo_wheel(robot, Wheel::right, right_m_s, ceiling_Nm);
}

template <typename AnyWorld>
void drive_straight(AnyWorld& world, double speed_m_s) {
  drive(world, 0, speed_m_s, speed_m_s, robot_spec(Role::forward).max_wheel_torque_Nm);
}

template <typename AnyWorld>
void run(AnyWorld& world, double seconds) {
  const auto steps = std::lround(seconds / world.step_s());
  for (long i = 0; i < steps; ++i) {
    world.step();
  }
}

// -1, 0 and 1: backward, stop and forward.
using Actions = std::vector<int>;

inline Actions random_actions(std::uint64_t episode) {
  constexpr std::uint64_t stream = 99;
  Random random(7, episode, stream);
  Actions actions;
  for (int i = 0; i < kick_decisions; ++i) {
    actions.push_back(static_cast<int>(random.below(3)) - 1);
  }
  return actions;
}

template <typename AnyWorld>
KickOutcome play(AnyWorld& world, const KickStart& start, const Actions& actions) {
  const auto steps = std::lround(decision_period_s / world.step_s());
  KickEpisode episode;
  episode.begin(world, start);
  for (const int action : actions) {
    drive_straight(world, action * robot_spec(Role::forward).max_rim_speed_m_s);
    for (long i = 0; i < steps; ++i) {
      episode.step(world);
    }
    episode.end_decision();
  }
  for (long i = 0; i < 2 * steps; ++i) {
    episode.step(world);
  }
  return episode.outcome();
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What a team tells a robot, in a frame of 50 ms: AI Soccer's own interface, wheel speeds, or a motion that the robot's
// controller knows. SI units; poses in the team's own frame (team_view.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

// Rim speeds, positive ahead. What is beyond a robot's top speed is cut to it, each wheel by itself.
struct SpeedOrder {
  double left_m_s = 0.0;
  double right_m_s = 0.0;

  bool operator==(const SpeedOrder&) const = default;
};

enum class Motion : std::uint8_t { kick };

// The same number goes on with the motion that was begun; another one, modulo 4, begins it anew.
struct MotionOrder {
  Motion motion = Motion::kick;
  std::uint8_t number = 0;
  Pose target;

  bool operator==(const MotionOrder&) const = default;
};

using RobotOrder = std::variant<SpeedOrder, MotionOrder>;

// By id. None: the robot is told nothing in this frame, and goes on with its last order for as long as that is good.
using TeamOrders = std::array<std::optional<RobotOrder>, robots_a_team>;

}  // namespace striker::sil

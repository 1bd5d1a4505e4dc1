// SPDX-License-Identifier: Apache-2.0
// What changes an order that the rules of the match, or a jam, would make a bad one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sil/match/team/order.hpp"
#include "sil/match/team/striker/situation.hpp"

namespace striker::sil {

// Out of the opponent's goal area in time: a robot that stays there for 1 s is sent home, and its goalkeeper out.
class GoalAreaWatch {
 public:
  // Whether this robot has to leave now.
  [[nodiscard]] bool has_to_leave(const Situation& now, std::size_t id);

 private:
  std::array<int, robots_a_team> frames_inside_ = {};
};

// A robot that is one too many in a penalty area, or comes near one that is full, and where it goes instead. With the ball
// there, more than three defenders or two attackers in an area end play for the other team's good. The goalkeeper and
// the chaser have the first claim.
[[nodiscard]] std::optional<Vec2> way_out(const Situation& now, std::size_t id);

// Somebody who is told to drive and does not move sweeps the ball ahead if it is there, and else backs off for a
// while, in a curve to the middle.
class Unstick {
 public:
  [[nodiscard]] SpeedOrder changed(const Situation& now, std::size_t id, SpeedOrder wheels);

 private:
  std::array<Pose, robots_a_team> before_ = {};
  std::array<double, robots_a_team> stuck_s_ = {};
  std::array<double, robots_a_team> free_for_s_ = {};
  std::array<int, robots_a_team> times_ = {};
};

}  // namespace striker::sil

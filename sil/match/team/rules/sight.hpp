// SPDX-License-Identifier: Apache-2.0
// What the rule-based players ask of what they see, in this frame and the one before (AI World Cup examples ae937e6).
// After a stop (a frame with a reset reason) the frame before counts as this one.
#pragma once

#include <array>
#include <cstddef>

#include "sil/match/team/team_view.hpp"

namespace striker::sil {

// The ball's radius as players are told it; it is 0.05 in the world.
inline constexpr double told_ball_radius_m = 0.04;

struct Glimpse {
  std::array<Pose, robots_a_team> own;
  std::array<Pose, robots_a_team> opponents;
  std::array<bool, robots_a_team> active = {};    // own
  std::array<bool, robots_a_team> touching = {};  // own
  Vec2 ball;
};

struct Sight {
  Glimpse now;
  Glimpse before;
};

[[nodiscard]] Glimpse glimpse_of(const TeamView& view);

// Straight on, at the last frame's pace: p_n.
[[nodiscard]] Vec2 ball_in_frames(const Sight& sight, double frames);

// Nearest to the ball of robots 1 and 2, and of 3 and 4; the lower one if they are as near, and whether active or not.
[[nodiscard]] std::size_t nearest_defender(const Glimpse& now);
[[nodiscard]] std::size_t nearest_forward(const Glimpse& now);

// Whether the line from robot to ball goes on into the opponent's goal. As published, its height is counted from the
// robot's y and not from the ball's: it is off by what they differ.
[[nodiscard]] bool has_shoot_chance(Vec2 robot, Vec2 ball);

// Whether the ball has come nearer to where the robot is now, in x and in y.
[[nodiscard]] bool ball_comes_to(const Sight& sight, std::size_t id);

// Own, with its side borders, and without a far limit.
[[nodiscard]] bool in_own_penalty_area(Vec2 spot);

}  // namespace striker::sil

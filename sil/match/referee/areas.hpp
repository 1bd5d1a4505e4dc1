// SPDX-License-Identifier: Apache-2.0
// The parts of the field that rules ask for, by the centre of a ball or robot. "Own" is in the frame of a robot's or a
// goal's own team, whose goal is at -x. What is the same at both ends asks for |x| and |y|.
//
// Sizes and borders are those of the published referee (AI World Cup test_world 37312a93): the line itself is beyond
// in none of them, and belongs to the penalty area for the ball alone.
#pragma once

#include <cmath>

#include "sil/world/field_specs.hpp"
#include "sil/world/pose.hpp"

namespace striker::sil {

inline constexpr double penalty_line_m = field_half_length_m - 0.9;  // |x|: 0.9 deep
inline constexpr double penalty_half_width_m = 0.9;
inline constexpr double goal_area_line_m = field_half_length_m - 0.4;  // |x|: 0.4 deep
inline constexpr double goal_area_half_width_m = 0.65;
inline constexpr double wall_thickness_m = 0.025;  // a ball is out beyond it

[[nodiscard]] inline bool in_a_goal(Vec2 ball) {
  return std::abs(ball.x) > field_half_length_m && std::abs(ball.y) < goal_half_width_m;
}

[[nodiscard]] inline bool beyond_end_line(Vec2 ball) {
  return std::abs(ball.x) > field_half_length_m + wall_thickness_m &&
         std::abs(ball.y) > goal_half_width_m + wall_thickness_m;
}
[[nodiscard]] inline bool beyond_side_line(Vec2 ball) {
  return std::abs(ball.y) > field_half_width_m + wall_thickness_m;
}
// The line through (3.8, 2.35) and (3.925, 2.225): the corner's cut, a wall further out.
[[nodiscard]] inline bool beyond_corner_cut(Vec2 ball) {
  return std::abs(ball.x) + std::abs(ball.y) >
         field_half_length_m - corner_leg_m + field_half_width_m + wall_thickness_m;
}

// Beside the posts there is a strip, 25 mm to both sides of end line and goal, that is neither out nor goal.
[[nodiscard]] inline bool is_out(Vec2 ball) {
  return beyond_end_line(ball) || beyond_side_line(ball) || beyond_corner_cut(ball);
}

// A robot may be as far in the goals as they are deep. The side walls are not asked for: they are walls.
[[nodiscard]] inline bool has_left_field(Vec2 robot) {
  const double end_m = std::abs(robot.y) < goal_half_width_m ? goal_back_m : field_half_length_m;
  return std::abs(robot.x) > end_m;
}

// In the frame of the team that defends it; without a far limit, so that it goes on behind the line.
[[nodiscard]] inline bool in_own_penalty_strip(Vec2 robot) {
  return robot.x < -penalty_line_m && std::abs(robot.y) < penalty_half_width_m;
}
// In the frame of the team that defends it. `ball_y` says which of the two corners; 0 counts as negative.
[[nodiscard]] inline bool in_own_corner(Vec2 robot, double ball_y) {
  return robot.x < -penalty_line_m && (ball_y > 0.0 ? robot.y : -robot.y) > penalty_half_width_m;
}
// Where crowding is judged: the ball's own test takes the borders in.
[[nodiscard]] inline bool ball_in_a_penalty_area(Vec2 ball) {
  return std::abs(ball.x) >= penalty_line_m && std::abs(ball.y) <= penalty_half_width_m;
}

// In the robot's own frame.
[[nodiscard]] inline bool in_opponents_goal_area(Vec2 robot) {
  const double half_width_m = robot.x > field_half_length_m ? goal_half_width_m : goal_area_half_width_m;
  return robot.x > goal_area_line_m && std::abs(robot.y) < half_width_m;
}
// In the goalkeeper's own frame: its penalty area, and its goal.
[[nodiscard]] inline bool keeper_is_home(Vec2 keeper) {
  const double half_width_m = keeper.x < -field_half_length_m ? goal_half_width_m : penalty_half_width_m;
  return keeper.x < -penalty_line_m && std::abs(keeper.y) < half_width_m;
}

// Where the straight way of a ball from a frame to the next meets the edge of the field (end lines and side lines). If
// it was beyond already, or comes from nowhere, the point of the field that is nearest to where it is.
[[nodiscard]] Vec2 exit_point(Vec2 before, Vec2 now);

}  // namespace striker::sil

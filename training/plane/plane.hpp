// SPDX-License-Identifier: Apache-2.0
// A plane through the relative state: two of its numbers vary, the others are held. In each of its cells stands what a float
// network decides, what its integers decide, and what the planner (line_play.hpp, the rival of striker-ceiling) makes of it.
//
//   const Plane plane = {.x = {.number = PlaneNumber::ball_x_m, .from = -1.0, .to = 2.0}, ...};
//   const std::vector<PlaneCell> cells = fill(plane, model.parameters, integers, task);   // cells[row * plane.cells + column]
//
// Where a network reads earlier decisions, the robot has kept its speed, and the ball came as it would have rolled.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "training/export/integer_network.hpp"
#include "training/learner/network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// What a kick's relative state is made of; a ball's angle follows from its velocity.
enum class PlaneNumber { ball_x_m, ball_y_m, robot_speed_m_s, ball_vx_m_s, ball_vy_m_s, decisions_left };
inline constexpr std::array<std::string_view, 6> plane_number_names = {
    "ball_x_m", "ball_y_m", "robot_speed_m_s", "ball_vx_m_s", "ball_vy_m_s", "decisions_left"};

// One value a number, in the order of the names.
using PlaneState = std::array<double, plane_number_names.size()>;

struct PlaneAxis {
  PlaneNumber number = PlaneNumber::ball_x_m;
  double from = 0.0;
  double to = 0.0;

  // The middle of a cell: `from` of the first, `to` of the last. Decisions are whole.
  [[nodiscard]] double at(int cell, int cells) const;
};

struct Plane {
  PlaneAxis x, y;
  PlaneState held{};  // what x and y say of it does not count
  int cells = 0;      // along each axis, at least 2
};

inline constexpr std::size_t plane_actions = 3;  // forward, stop, backward

struct PlaneCell {
  std::array<double, plane_actions> float_q{};
  std::array<double, plane_actions> integer_q{};  // in the same unit, from whole 1/256
  int float_action = 0;
  int integer_action = 0;
  int planner_action = 0;
  // The reward from here on of each action, if the planner goes on after it.
  std::array<double, plane_actions> planned{};
  bool contact = false;  // the planner meets the ball
  bool touches = false;  // the ball is where the robot is: nothing is left to plan, and `planned` is 0
};

// Why a task has no such plane: "KEY: what it must be"; empty if it has.
[[nodiscard]] std::string unfit_for_plane(const TaskConfig& task);

// All cells, row by row from y.from on. `row_done` is called after each row; false ends it there, with fewer cells. A cell
// takes about 0.2 ms, of an aimed kick 50 ms. The task fits, and so do the networks.
[[nodiscard]] std::vector<PlaneCell> fill(
    const Plane& plane, const Parameters& network, const IntegerNetwork& integers, const TaskConfig& task,
    const std::function<bool()>& row_done = [] { return true; });

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/plane/plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "training/line/line_episode.hpp"
#include "training/line/line_play.hpp"
#include "training/task/described_delays.hpp"

namespace striker::training {

namespace {

constexpr int stay = 1;

double number_of(const PlaneState& state, PlaneNumber number) {
  return state[static_cast<std::size_t>(number)];
}

PlaneState state_at(const Plane& plane, int column, int row) {
  PlaneState state = plane.held;
  state[static_cast<std::size_t>(plane.x.number)] = plane.x.at(column, plane.cells);
  state[static_cast<std::size_t>(plane.y.number)] = plane.y.at(row, plane.cells);
  return state;
}

sil::BallState ball_of(const PlaneState& state) {
  return {.position_m = {number_of(state, PlaneNumber::ball_x_m), number_of(state, PlaneNumber::ball_y_m)},
          .velocity_m_s = {number_of(state, PlaneNumber::ball_vx_m_s),
                           number_of(state, PlaneNumber::ball_vy_m_s)}};
}

// The robot is where the frame begins now, and comes along it.
History history_of(const PlaneState& state) {
  History history;
  const double speed_m_s = number_of(state, PlaneNumber::robot_speed_m_s);
  for (int ago = greatest_look_back; ago >= 0; --ago) {
    const double ago_s = ago * sil::decision_period_s;
    DecisionState then;
    then.field = {.robot = {.x_m = -speed_m_s * ago_s, .y_m = 0.0, .heading_rad = 0.0},
                  .robot_velocity_m_s = {speed_m_s, 0.0},
                  .ball = sil::ball_before({.robot = {}, .ball = ball_of(state)}, ago_s)};
    then.rcs = rcs_state(then.field, Equations::corrected);
    then.decisions_left = static_cast<int>(number_of(state, PlaneNumber::decisions_left)) + ago;
    ago == greatest_look_back ? history.begin(then) : history.add(then);
  }
  return history;
}

// What the decision and then the planner get from here on.
double planned_reward(const LineDrive& drive, const PlaneState& state, int action) {
  const int left = static_cast<int>(number_of(state, PlaneNumber::decisions_left));
  const double set_point_m_s = drive.set_points_m_s[static_cast<std::size_t>(action)];
  const BallTrack track = ball_track(ball_of(state), left * steps_per_decision);
  LineState robot{.position_m = 0.0, .speed_m_s = number_of(state, PlaneNumber::robot_speed_m_s)};
  for (int step = 0; step < steps_per_decision; ++step) {
    if (track.depth_m(step, robot.position_m) >= 0.0) {
      return contact_reward(drive, track, step, robot, set_point_m_s,
                            -std::numeric_limits<double>::infinity());
    }
    advance(robot, set_point_m_s, drive.gain_limit_m_s);
  }
  if (left == 1) {
    return official.waiting_reward;
  }
  sil::BallState ball = track.ball(steps_per_decision);
  ball.position_m.x -= robot.position_m;
  const PlanValue then = best_plan(drive, ball_track(ball, (left - 1) * steps_per_decision),
                                   {.position_m = 0.0, .speed_m_s = robot.speed_m_s}, left - 1);
  const double nothing = (left - 1) * official.waiting_reward;
  return official.waiting_reward + (then.contact ? std::max(then.reward, nothing) : nothing);
}

void plan(const LineDrive& drive, const PlaneState& state, PlaneCell& cell) {
  cell.planner_action = stay;
  cell.touches = ball_track(ball_of(state), 1).depth_m(0, 0.0) >= 0.0;
  if (cell.touches) {
    return;
  }
  for (std::size_t action = 0; action < plane_actions; ++action) {
    cell.planned[action] = planned_reward(drive, state, static_cast<int>(action));
  }
  const int left = static_cast<int>(number_of(state, PlaneNumber::decisions_left));
  const PlanValue best =
      best_plan(drive, ball_track(ball_of(state), left * steps_per_decision),
                {.position_m = 0.0, .speed_m_s = number_of(state, PlaneNumber::robot_speed_m_s)}, left);
  cell.contact = best.contact && best.reward > left * official.waiting_reward;
  cell.planner_action = cell.contact ? best.plan.action(0) : stay;
}

}  // namespace

double PlaneAxis::at(int cell, int cells) const {
  const double value = from + (to - from) * cell / (cells - 1);
  return number == PlaneNumber::decisions_left ? std::round(value) : value;
}

std::string unfit_for_plane(const TaskConfig& task) {
  if (std::string why = LineKick::unfit(task); !why.empty()) {
    return why;
  }
  const auto& actions = task.actions;
  const auto set_points = line_drive(task.robot).set_points_m_s;
  const bool are_the_kicks = std::equal(
      actions.begin(), actions.end(), set_points.begin(), set_points.end(),
      [](const SetPoint& action, double set_point_m_s) { return action.left_m_s == set_point_m_s; });
  if (!are_the_kicks) {
    return "task.actions: must be forward, stop and backward at the robot's top speed, as the planner's are";
  }
  const DescribedDelays delays = described_delays(task.robot);
  if (delays.command_steps + delays.picture_steps > 0) {
    return "robot.command_delay_ms and robot.camera_latency_ms: must be 0: the planner here knows no delays";
  }
  return "";
}

std::vector<PlaneCell> fill(const Plane& plane, const Parameters& network, const IntegerNetwork& integers,
                            const TaskConfig& task, const std::function<bool()>& row_done) {
  const LineDrive drive = line_drive(task.robot, task.rules.reward);
  Actor actor(network.shape());
  Features features(task.inputs.size());
  sil::Random no_dummies(0, 0, 0);
  std::vector<PlaneCell> cells;
  for (int row = 0; row < plane.cells; ++row) {
    for (int column = 0; column < plane.cells; ++column) {
      const PlaneState state = state_at(plane, column, row);
      const History history = history_of(state);
      const bool mirror = task.one_sided && number_of(state, PlaneNumber::ball_y_m) < 0.0;
      write_features(task.inputs, history, mirror, no_dummies, features);
      const auto q = actor.values(network, features);
      const IntegerAnswer answer = evaluate(integers, raw_state(task.inputs, history, mirror));
      PlaneCell& cell = cells.emplace_back();
      cell.float_action = greedy_action(q);
      cell.integer_action = static_cast<int>(answer.action);
      for (std::size_t action = 0; action < plane_actions; ++action) {
        cell.float_q[action] = q[static_cast<Eigen::Index>(action)];
        cell.integer_q[action] = (answer.sums[action] >> integers.layers.back().shift) / 256.0;
      }
      plan(drive, state, cell);
    }
    if (!row_done()) {
      return cells;
    }
  }
  return cells;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/statistics/match_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sil/match/record/statistics/sides.hpp"
#include "sil/match/referee/areas.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

constexpr double third_m = field_half_length_m / 3.0;  // |x|

bool clock_runs(GameState state) {
  return state != GameState::pause && state != GameState::over;
}

// Whether this robot has the ball, by AI Soccer's rule of 2020.
bool controls(const Pose& pose, const RobotRecord& robot, const BallSeen& ball,
              const std::array<double, 3>& ball_velocity_m_s) {
  const double dx_m = ball.position_m.x - pose.x_m;
  const double dy_m = ball.position_m.y - pose.y_m;
  const double relative_m_s =
      std::hypot(ball_velocity_m_s[0] - robot.velocity_m_s.x, ball_velocity_m_s[1] - robot.velocity_m_s.y);
  const double reach_m = robot_side_m / 2.0 + 0.05 + 0.13 * std::max(0.5, relative_m_s);
  const double bearing_rad =
      std::remainder(std::atan2(dy_m, dx_m) - pose.heading_rad, 2.0 * std::numbers::pi);
  return std::hypot(dx_m, dy_m) < reach_m && std::abs(bearing_rad) < std::numbers::pi / 4.0 &&
         std::abs(ball.height_m - robot.height_m) < 0.01;
}

}  // namespace

std::optional<bool> is_answered(const MatchFrame& frame, Team team) {
  const auto& orders = frame.orders[index_of(team)];
  std::optional<bool> answered;
  for (std::size_t id = 0; orders && id < robots_a_team; ++id) {
    if (frame.ruling.may_move(robot_of(team, id))) {
      answered = answered.value_or(false) || (*orders)[id].has_value();
    }
  }
  return answered;
}

void MatchStatistics::add(const MatchFrame& frame) {
  const Ruling& ruling = frame.ruling;
  ++figures_.frames;
  if (frame.number > 0) {
    figures_.state_ms[static_cast<std::size_t>(state_)] += frame_ms;
  }
  if (clock_runs(state_)) {
    add_play(frame);
  }
  add_controllers(frame);
  add_answers(frame);
  add_events(ruling);
  if (clock_runs(state_) && !clock_runs(ruling.state)) {
    const bool is_goal = std::ranges::count(ruling.events, EventKind::goal, &MatchEvent::kind) > 0;
    shots_.stop(is_goal, figures_);
    touches_.stop();
    kicks_.stop();
  }
  figures_.score = ruling.score;
  figures_.half = ruling.half;
  figures_.clock_ms = ruling.clock_ms;
  figures_.sim_ms = ruling.sim_ms;
  state_ = ruling.state;
  locked_ = ruling.locked;
  sent_out_ = ruling.sent_out;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    placed_[robot] = ruling.placements.robots[robot].value_or(frame.seen.robots[robot]);
  }
}

void MatchStatistics::add_play(const MatchFrame& frame) {
  touches_.add(frame.seen, figures_);
  shots_.add(frame.seen, frame.ball_velocity_m_s, frame.ruling.half, figures_);
  kicks_.add(frame, figures_);
  add_places(frame.seen, frame.ruling.half);
  add_keepers(frame.seen, frame.ruling.half);
  add_control(frame);
  add_robots(frame);
}

void MatchStatistics::add_places(const RefereeFrame& seen, int half) {
  bool in_the_middle = true;
  for (const Team team : teams) {
    const Vec2 ball = own_spot(team, half, seen.ball.position_m);
    if (ball.x > third_m) {
      of(team).attacking_third_ms += frame_ms;
      in_the_middle = false;
    }
    const bool in_area = in_own_penalty_strip(turned(ball));
    if (in_area && !ball_in_area_[index_of(team)] && touches_.holder() == team) {
      ++of(team).penalty_area_entries;
    }
    ball_in_area_[index_of(team)] = in_area;
  }
  figures_.middle_third_ms += in_the_middle ? frame_ms : 0;
}

void MatchStatistics::add_keepers(const RefereeFrame& seen, int half) {
  for (const Team team : teams) {
    const std::size_t keeper = robot_of(team, goalkeeper_id);
    if (sent_out_[keeper]) {
      continue;
    }
    const Pose& pose = seen.robots[keeper];
    const Vec2 own = own_spot(team, half, {pose.x_m, pose.y_m});
    const Vec2 ball = own_spot(team, half, seen.ball.position_m);
    of(team).keeper_line_sum_m += std::abs(own.x + field_half_length_m);
    of(team).keeper_lag_sum_m += std::abs(std::clamp(ball.y, -goal_half_width_m, goal_half_width_m) - own.y);
    ++of(team).keeper_frames;
  }
}

void MatchStatistics::add_control(const MatchFrame& frame) {
  std::array<bool, 2> has_ball = {};
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    has_ball[index_of(team_of(robot))] |=
        !sent_out_[robot] &&
        controls(frame.seen.robots[robot], frame.robots[robot], frame.seen.ball, frame.ball_velocity_m_s);
  }
  for (const Team team : teams) {
    of(team).control_ms += has_ball[index_of(team)] ? frame_ms : 0;
  }
}

void MatchStatistics::add_robots(const MatchFrame& frame) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    of(team_of(robot)).out_ms += sent_out_[robot] ? frame_ms : 0;
    if (sent_out_[robot] || locked_[robot]) {
      continue;
    }
    RobotFigures& figures = figures_.robots[robot];
    const RobotRecord& record = frame.robots[robot];
    const Pose& pose = frame.seen.robots[robot];
    ++figures.play_frames;
    figures.way_m += std::hypot(pose.x_m - placed_[robot].x_m, pose.y_m - placed_[robot].y_m);
    figures.undriven_ms += is_driven(record) ? 0 : frame_ms;
    figures.saturated_ticks += record.saturated_ticks;
    if (record.order_age_ms) {
      figures.order_age_sum_ms += *record.order_age_ms;
      figures.order_age_max_ms = std::max(figures.order_age_max_ms, *record.order_age_ms);
      ++figures.order_frames;
    }
  }
}

void MatchStatistics::add_controllers(const MatchFrame& frame) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const RobotRecord& record = frame.robots[robot];
    figures_.robots[robot].lost_frames += record.lost_frames;
    if (record.fault != core::Fault::none && record.fault != faults_[robot]) {
      ++figures_.robots[robot].faults[static_cast<std::size_t>(record.fault)];
    }
    faults_[robot] = record.fault;
  }
}

void MatchStatistics::add_answers(const MatchFrame& frame) {
  for (const Team team : teams) {
    const auto answered = is_answered(frame, team);
    of(team).asked_frames += answered ? 1 : 0;
    of(team).unanswered_frames += answered == false ? 1 : 0;
  }
}

void MatchStatistics::add_events(const Ruling& ruling) {
  for (const MatchEvent& event : ruling.events) {
    switch (event.kind) {
      case EventKind::goal:
        ++of(*event.team).goals;
        if (event.cause == Cause::own_goal) {
          ++of(opponent_of(*event.team)).own_goals;
        } else {
          shots_.score(*event.team, figures_);
        }
        break;
      case EventKind::ball_out:
      case EventKind::crowding:
      case EventKind::deadlock:
        add_stop(event);
        break;
      case EventKind::sent_out:
      case EventKind::out_anew:
      case EventKind::sent_home:
        add_robot_event(event);
        break;
      default:
        break;
    }
  }
}

void MatchStatistics::add_stop(const MatchEvent& event) {
  figures_.deadlocks += event.kind == EventKind::deadlock ? 1 : 0;
  if (!event.set_piece) {
    ++figures_.drops;
    return;
  }
  TeamFigures& team = of(*event.team);
  SetPieces& pieces = event.set_piece == GameState::goal_kick ? team.goal_kicks
                      : event.set_piece == GameState::corner  ? team.corners
                                                              : team.penalties;
  ++(event.kind == EventKind::ball_out   ? pieces.after_out
     : event.kind == EventKind::crowding ? pieces.after_crowding
                                         : pieces.after_deadlock);
}

void MatchStatistics::add_robot_event(const MatchEvent& event) {
  TeamFigures& team = of(*event.team);
  if (event.kind == EventKind::sent_home) {
    ++(event.cause == Cause::goal_area ? team.sent_home : team.keeper_sent_home);
  } else {
    ++(event.cause == Cause::fallen       ? team.fallen
       : event.cause == Cause::left_field ? team.left_field
                                          : team.keeper_sent_out);
  }
}

}  // namespace striker::sil

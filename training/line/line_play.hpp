// SPDX-License-Identifier: Apache-2.0
// The kick task on one line. The three actions drive straight, so the robot's centre stays on the line of its
// initial heading, and until the contact nothing moves it but its wheels: two numbers are its whole state.
// The ball rolls on freely meanwhile. The arithmetic is that of the fast world (sil/world/planar_robot.hpp).
//
// Everything is in the frame of the robot at the start: x along the heading.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sil/world/planar_robot.hpp"
#include "training/line/leaving_ball.hpp"
#include "training/line/line_state.hpp"

namespace striker::training {

// What a robot can do on its line, and what it is paid for.
struct LineDrive {
  double top_speed_m_s;   // what starts at rest is never faster
  double gain_limit_m_s;  // of the speed in a physics step, by the wheels
  // Forward, stop, backward: both wheels' (paper, section IV.A).
  std::array<double, 3> set_points_m_s;
  sil::KickReward reward = sil::KickReward::contact;
  Bodies bodies;

  // The most that the speed changes by in a physics step: the wheels' gain, and what damping takes beside it when the
  // robot reverses, each to the next mm/s.
  [[nodiscard]] double most_gain_m_s() const {
    return (std::ceil(1e3 * gain_limit_m_s) + std::ceil(1e3 * (1.0 - sil::kept_in_10_ms) * top_speed_m_s)) /
           1e3;
  }
};

// The official task, which the ceiling is of. The aimed kick waits as it does.
inline constexpr sil::KickRules official;
inline constexpr double no_contact_reward = sil::kick_decisions * official.waiting_reward;

inline constexpr int task_steps = sil::kick_decisions * steps_per_decision;

[[nodiscard]] LineDrive line_drive(const core::RobotDescription& robot,
                                   sil::KickReward reward = sil::KickReward::contact);

// Where the ball is before each physics step, and how far from its x the robot's centre touches it there:
// below 0 nowhere.
struct BallTrack {
  std::array<double, task_steps> x_m;
  std::array<double, task_steps> y_m;
  std::array<double, task_steps> reach_m;
  std::array<sil::Vec2, task_steps> velocity_m_s;
  // Steps outside [first, end) have no reach. None: first = end.
  int first = 0;
  int end = 0;
  int begun = 0;  // physics steps of the episode before the track's first

  // Before this step of the track.
  [[nodiscard]] constexpr int decisions_waited(int step) const { return (begun + step) / steps_per_decision; }

  // How far inside the contact the robot is, along its line. Below 0: no contact.
  [[nodiscard]] double depth_m(int step, double position_m) const {
    const auto n = static_cast<std::size_t>(step);
    return reach_m[n] - std::abs(x_m[n] - position_m);
  }
  [[nodiscard]] sil::BallState ball(int step) const {
    const auto n = static_cast<std::size_t>(step);
    return {.position_m = {x_m[n], y_m[n]}, .velocity_m_s = velocity_m_s[n]};
  }
};

// `ball` in the robot's frame, now; only `steps` physics steps are left, in each of which it keeps the share `kept` of
// its velocity.
[[nodiscard]] BallTrack ball_track(sil::BallState ball, int steps = task_steps,
                                   double kept = sil::kept_in_10_ms);
// From this physics step of the episode on.
[[nodiscard]] BallTrack ball_track(const sil::KickStart& start, int begun = 0);

// The official waiting before this step.
[[nodiscard]] constexpr Waited waited_until(const BallTrack& track, int step) {
  return {.reward_a_decision = official.waiting_reward, .decisions = track.decisions_waited(step)};
}

// What the official contact pays, with what waiting costs.
[[nodiscard]] inline double contact_reward(const BallTrack& track, int step, const LineState& robot) {
  const auto n = static_cast<std::size_t>(step);
  const double ahead_m = track.x_m[n] - robot.position_m;
  const int waited = track.decisions_waited(step);
  return official.waiting_reward * waited +
         official.angle_reward * ahead_m / std::hypot(ahead_m, track.y_m[n]) +
         official.speed_reward_s_m * robot.speed_m_s;
}

// The same of the task that the drive is paid for, of a decision that goes on with this set-point. An aimed contact that
// cannot beat `to_beat` may be told as anything up to that.
[[nodiscard]] inline double contact_reward(const LineDrive& drive, const BallTrack& track, int step,
                                           const LineState& robot, double set_point_m_s, double to_beat) {
  return drive.reward == sil::KickReward::contact
             ? contact_reward(track, step, robot)
             : aimed_contact_reward(drive.bodies, robot, track.ball(step), {.set_point_m_s = set_point_m_s},
                                    waited_until(track, step), to_beat);
}

// Reverse, wait, then forward to the end, each for some decisions.
struct Plan {
  int reverse = 0;
  int wait = 0;

  [[nodiscard]] int action(int decision) const {
    return decision < reverse ? 2 : static_cast<int>(decision < reverse + wait);
  }
};

struct PlanValue {
  Plan plan;
  double reward = no_contact_reward;
  bool contact = false;
};

// The best of all plans that reverse for at most `most_reverse` decisions. With a margin: of those whose
// contact is at least so deep, after steps that all miss the ball by as much.
inline constexpr int most_reverse = 12;
[[nodiscard]] PlanValue best_plan(const LineDrive& drive, const BallTrack& track, const LineState& robot,
                                  int decisions, double margin_m = 0.0);

}  // namespace striker::training

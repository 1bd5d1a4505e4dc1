// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/kick_chance.hpp"

#include <algorithm>
#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/top_speed.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::sil {

namespace {

constexpr double aim_half_width_m = 0.4;  // of the goal's 0.5
constexpr double furthest_goal_m = 2.3;   // kicks leave within 20 degrees or so
constexpr double nearest_goal_m = 0.6;    // or it ends in the goal area
constexpr double slowest_ball_m_s = 0.8;
constexpr double fastest_ball_m_s = 3.5;
constexpr double slowest_crossing_m_s = 0.3;
constexpr double fastest_crossing_m_s = 2.2;  // a ball keeps much of its speed along the flat front
constexpr double fastest_leaving_m_s = 1.0;   // along the heading
constexpr double soonest_s = 0.3;             // before, the robot has no run-up
constexpr double latest_s = 1.0;              // after, somebody else mostly had the ball
constexpr double passes_within_m = 0.5;       // of the robot's centre: learned no further
constexpr double front_m = robot_side_m / 2.0 + ball_radius_m;
constexpr double back_m_s = 0.8;   // what the robot surely makes good by then, back
constexpr double ahead_m_s = 1.2;  // and ahead
constexpr int longest_frames = 40;
constexpr int frames_after_touch = 3;

bool faces_goal(const Pose& robot) {
  const double way_m = field_half_length_m - robot.x_m;
  const double cosine = std::cos(robot.heading_rad);
  if (cosine < 0.3 || way_m > furthest_goal_m || way_m < nearest_goal_m) {
    return false;
  }
  return std::abs(robot.y_m + way_m * std::tan(robot.heading_rad)) < aim_half_width_m;
}

// Ahead and to the left.
Vec2 seen_by(const Pose& robot, Vec2 way) {
  const double cosine = std::cos(robot.heading_rad);
  const double sine = std::sin(robot.heading_rad);
  return {cosine * way.x + sine * way.y, cosine * way.y - sine * way.x};
}

}  // namespace

bool has_kick_chance(const Situation& now, std::size_t id) {
  const RobotView& view = now.view.own[id];
  if (role_of(id) != Role::forward || !view.active || now.view.state != GameState::open_play ||
      !faces_goal(view.pose)) {
    return false;
  }
  const Vec2 velocity = seen_by(view.pose, now.ball.velocity_m_s());
  const double speed_m_s = std::sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
  const double crossing_m_s = std::abs(velocity.y);
  if (speed_m_s < slowest_ball_m_s || speed_m_s > fastest_ball_m_s || crossing_m_s < slowest_crossing_m_s ||
      crossing_m_s > fastest_crossing_m_s || velocity.x > fastest_leaving_m_s) {
    return false;
  }
  const Vec2 way = seen_by(view.pose, {now.ball.now().x - view.pose.x_m, now.ball.now().y - view.pose.y_m});
  if (std::abs(way.x * velocity.y - way.y * velocity.x) > passes_within_m * speed_m_s) {
    return false;
  }
  const double time_s = -way.y / velocity.y;  // to where it crosses the robot's line
  const double there_m = way.x + velocity.x * time_s - front_m;
  return time_s > soonest_s && time_s < latest_s && there_m > -back_m_s * time_s &&
         there_m < ahead_m_s * time_s;
}

bool Kicks::goes_on(const Situation& now) const {
  const RobotView& robot = now.view.own[kicker_];
  if (now.view.reset_reason != ResetReason::none || !robot.active || frames_ >= longest_frames ||
      touched_frames_ >= frames_after_touch) {
    return false;
  }
  const Vec2 velocity = now.ball.velocity_m_s();
  const Vec2 way = {now.ball.now().x - robot.pose.x_m, now.ball.now().y - robot.pose.y_m};
  const bool leaves = way.x * velocity.x + way.y * velocity.y > 0.0;
  return !leaves || std::sqrt(way.x * way.x + way.y * way.y) < 0.5;
}

std::size_t Kicks::kicker(const Situation& now) {
  if (kicker_ != nobody) {
    ++frames_;
    touched_frames_ += touched_frames_ > 0 || now.view.own[kicker_].touching ? 1 : 0;
    if (goes_on(now)) {
      return kicker_;
    }
    kicker_ = nobody;
  }
  for (std::size_t id = 1; id < robots_a_team; ++id) {
    if (has_kick_chance(now, id)) {
      kicker_ = id;
      frames_ = 0;
      touched_frames_ = 0;
      number_ = static_cast<std::uint8_t>((number_ + 1) % 4);
      break;
    }
  }
  return kicker_;
}

MotionOrder Kicks::order(const Situation& now) const {
  const Pose& robot = now.view.own[kicker_].pose;
  return {.motion = Motion::kick,
          .number = number_,
          .target = {field_half_length_m,
                     robot.y_m + (field_half_length_m - robot.x_m) * std::tan(robot.heading_rad),
                     robot.heading_rad}};
}

}  // namespace striker::sil

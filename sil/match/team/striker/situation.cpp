// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/situation.hpp"

#include <cmath>

#include "sil/match/team/plane.hpp"
#include "sil/match/team/top_speed.hpp"

namespace striker::sil {

namespace {

constexpr double furthest_m = 10.0;
constexpr double longest_s = 3.0;
constexpr double look_every_s = 0.05;
constexpr double reach_m = 0.12;      // from a robot's centre to the ball's
constexpr double usual_share = 0.75;  // of its top speed
constexpr double go_round_s = 0.35;
constexpr double inactive_s = 20.0;

void make_sane(double& value) {
  if (!(std::abs(value) < furthest_m)) {
    value = 0.0;
  }
}

void make_sane(Pose& pose) {
  make_sane(pose.x_m);
  make_sane(pose.y_m);
  make_sane(pose.heading_rad);
}

Interception interception(const RobotView& robot, const BallTrack& ball, double top_m_s) {
  Interception result = {ball.now(), longest_s};
  for (int look = 0; look * look_every_s < longest_s; ++look) {
    const double time_s = look * look_every_s;
    const Vec2 there = ball.in(time_s);
    if (distance_m(place_of(robot.pose), there) - reach_m < usual_share * top_m_s * time_s) {
      result = {there, time_s};
      break;
    }
  }
  if (robot.pose.x_m > result.ball.x - 0.05) {
    result.time_s += go_round_s;
  }
  if (!robot.active) {
    result.time_s += inactive_s;
  }
  return result;
}

// For leaving its part of the field.
double handicap_s(std::size_t id, Vec2 ball) {
  if (role_of(id) == Role::defender) {
    return ball.x > 0.8 ? 1.0 : 0.0;
  }
  return ball.x < -1.6 ? 0.5 : 0.0;
}

}  // namespace

TeamView made_sane(TeamView view) {
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    make_sane(view.own[id].pose);
    make_sane(view.opponents[id].pose);
  }
  make_sane(view.ball_m.x);
  make_sane(view.ball_m.y);
  return view;
}

std::array<Interception, robots_a_team> interceptions_of(const TeamView& view, const BallTrack& ball) {
  std::array<Interception, robots_a_team> result;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    result[id] = interception(view.own[id], ball, top_speed_m_s(id));
  }
  return result;
}

std::size_t chaser_of(const std::array<Interception, robots_a_team>& interceptions, Vec2 ball,
                      std::size_t before) {
  constexpr double again_s = 0.1;
  std::size_t chaser = 1;
  double least_s = 1e9;
  for (std::size_t id = 1; id < robots_a_team; ++id) {
    const double time_s = interceptions[id].time_s + handicap_s(id, ball) - (id == before ? again_s : 0.0);
    if (time_s < least_s) {
      least_s = time_s;
      chaser = id;
    }
  }
  return chaser;
}

}  // namespace striker::sil

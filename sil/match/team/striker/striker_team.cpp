// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/striker_team.hpp"

#include "sil/match/team/plane.hpp"
#include "sil/match/team/striker/drive.hpp"
#include "sil/match/team/striker/roles.hpp"
#include "sil/match/team/top_speed.hpp"
#include "sil/world/field_specs.hpp"

namespace striker::sil {

TeamOrders StrikerTeam::play(const TeamView& seen) {
  const TeamView view = made_sane(seen);
  ball_.see(view);
  Situation now = {.view = view, .ball = ball_, .interceptions = interceptions_of(view, ball_)};
  chaser_ = chaser_of(now.interceptions, ball_.now(), chaser_);
  const std::size_t kicker = options_.kicks ? kicks_.kicker(now) : nobody;
  now.chaser = kicker == nobody ? chaser_ : kicker;
  TeamOrders orders;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    if (id == kicker) {
      orders[id] = kicks_.order(now);
    } else {
      orders[id] = unstick_.changed(now, id, wheels_of(now, id));
    }
  }
  return orders;
}

SpeedOrder StrikerTeam::wheels_of(const Situation& now, std::size_t id) {
  const TeamView& view = now.view;
  const Pose& robot = view.own[id].pose;
  const double top_m_s = top_speed_m_s(id);
  if (view.has_ball && view.state == GameState::kickoff && id == kicker_id) {
    return drive_to(robot, {0.0, 0.0}, top_m_s, 2.0);
  }
  if (view.has_ball && ((view.state == GameState::penalty && id == kicker_id) ||
                        (view.state == GameState::goal_kick && id == goalkeeper_id))) {
    return {top_m_s, top_m_s};
  }
  if (id == goalkeeper_id) {
    return keep_goal(now);
  }
  if (goal_area_.has_to_leave(now, id)) {
    return drive_to(robot, {2.8, robot.y_m}, top_m_s, 1.5);
  }
  if (const auto out = way_out(now, id)) {
    return drive_to(robot, *out, top_m_s);
  }
  if (id == now.chaser) {
    return chase_ball(now, id);
  }
  const Vec2 post = post_of(now, id);
  if (options_.kicks && role_of(id) == Role::forward && robot.x_m > 1.0 &&
      distance_m(place_of(robot), post) < 0.15) {
    return face(robot, bearing_rad(place_of(robot), {field_half_length_m, 0.0}), top_m_s);
  }
  return drive_to(robot, post, top_m_s);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/striker/manners.hpp"

#include <algorithm>
#include <cmath>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/match_rules.hpp"
#include "sil/match/team/plane.hpp"
#include "sil/match/team/top_speed.hpp"

namespace striker::sil {

namespace {

constexpr double frame_s = frame_ms / 1000.0;
constexpr MatchRules rules = official();

// What a robot may still roll into.
constexpr double margin_m = 0.2;

bool is_at_area(Vec2 place, double end) {
  return end * place.x > penalty_line_m - margin_m && std::abs(place.y) < penalty_half_width_m + margin_m;
}

// By who has the first claim: the chaser, then by id, so that at the own end the goalkeeper is next.
std::size_t claim(const Situation& now, std::size_t id) {
  return id == now.chaser ? 0 : 1 + id;
}

bool is_one_too_many(const Situation& now, std::size_t id, double end, int most) {
  int before = 0;
  for (std::size_t other = 0; other < robots_a_team; ++other) {
    const bool counts = now.view.own[other].active && is_at_area(place_of(now.view.own[other].pose), end);
    before += counts && claim(now, other) < claim(now, id) ? 1 : 0;
  }
  return before >= most && is_at_area(place_of(now.view.own[id].pose), end);
}

}  // namespace

std::optional<Vec2> way_out(const Situation& now, std::size_t id) {
  const double end = now.view.own[id].pose.x_m < 0.0 ? -1.0 : 1.0;
  const int most = end < 0.0 ? rules.most_defenders : rules.most_attackers;
  if (!is_one_too_many(now, id, end, most)) {
    return std::nullopt;
  }
  return Vec2{end * (penalty_line_m - 2.0 * margin_m), now.view.own[id].pose.y_m};
}

bool GoalAreaWatch::has_to_leave(const Situation& now, std::size_t id) {
  const Vec2 place = place_of(now.view.own[id].pose);
  const bool is_near = place.x > goal_area_line_m - 0.05 && std::abs(place.y) < goal_area_half_width_m + 0.05;
  frames_inside_[id] = is_near ? frames_inside_[id] + 1 : 0;
  return is_near &&
         !(id == now.chaser && distance_m(place, now.ball.now()) < 0.25 && frames_inside_[id] < 14);
}

SpeedOrder Unstick::changed(const Situation& now, std::size_t id, SpeedOrder wheels) {
  const Pose robot = now.view.own[id].pose;
  const Pose before = before_[id];
  before_[id] = robot;
  const double moved_m = distance_m(place_of(before), place_of(robot)) +
                         0.05 * std::abs(wrapped_rad(robot.heading_rad - before.heading_rad));
  const bool is_stuck = now.view.own[id].active &&
                        std::abs(wheels.left_m_s) + std::abs(wheels.right_m_s) > 0.6 && moved_m < 0.006;
  stuck_s_[id] = is_stuck ? stuck_s_[id] + frame_s : std::max(0.0, stuck_s_[id] - 2.0 * frame_s);
  if (stuck_s_[id] > 0.6) {
    free_for_s_[id] = 0.4;
    stuck_s_[id] = 0.0;
    ++times_[id];
  }
  if (!(free_for_s_[id] > 0.0)) {
    return wheels;
  }
  free_for_s_[id] -= frame_s;
  const double top_m_s = top_speed_m_s(id);
  const Vec2 ball = now.ball.now();
  if (distance_m(place_of(robot), ball) < 0.2) {  // sweeps the ball ahead
    const double turn = ball.y > robot.y_m ? -1.0 : 1.0;
    return {-turn * top_m_s, turn * top_m_s};
  }
  const double direction = times_[id] % 2 == 1 ? 1.0 : -1.0;
  const SpeedOrder curve = {direction * 0.9 * top_m_s, direction * 0.6 * top_m_s};
  return robot.y_m > 0.0 ? curve : SpeedOrder{curve.right_m_s, curve.left_m_s};
}

}  // namespace striker::sil

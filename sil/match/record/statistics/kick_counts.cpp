// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/statistics/kick_counts.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "sil/match/record/statistics/sides.hpp"

namespace striker::sil {

namespace {

constexpr int frames_to_see_it_leave = 2;
constexpr double as_meant_rad = 15.0 * std::numbers::pi / 180.0;

double direction(Vec2 from, Vec2 to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

}  // namespace

void KickCounts::add(const MatchFrame& frame, MatchFigures& figures) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    TeamFigures& team = figures.teams[index_of(team_of(robot))];
    see_ball(kicks_[robot], robot, frame.seen, team);
    see_order(kicks_[robot], robot, frame, team);
  }
}

void KickCounts::see_ball(Kick& kick, std::size_t robot, const RefereeFrame& seen, TeamFigures& figures) {
  const Vec2 ball = seen.ball.position_m;
  if (kick.frames >= 0 && kick.frames-- == 0) {
    const double beside_rad = std::remainder(direction(kick.ball, ball) - direction(kick.ball, kick.target),
                                             2.0 * std::numbers::pi);
    figures.kicks_as_meant += ball != kick.ball && std::abs(beside_rad) <= as_meant_rad ? 1 : 0;
  }
  if (kick.number && !kick.met && seen.touching[robot]) {
    ++figures.kicks_met;
    kick.met = true;
    kick.ball = ball;
    kick.frames = frames_to_see_it_leave - 1;
  }
}

void KickCounts::see_order(Kick& kick, std::size_t robot, const MatchFrame& frame, TeamFigures& figures) {
  const auto& orders = frame.orders[index_of(team_of(robot))];
  if (!orders || !(*orders)[id_of(robot)] || !frame.ruling.may_move(robot)) {
    return;
  }
  const auto* motion = std::get_if<MotionOrder>(&*(*orders)[id_of(robot)]);
  if (motion == nullptr) {
    kick.number.reset();
  } else if (kick.number != motion->number) {
    ++figures.kicks;
    kick.number = motion->number;
    kick.met = false;
    kick.target = own_spot(team_of(robot), frame.ruling.half, {motion->target.x_m, motion->target.y_m});
  }
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/statistics/shots.hpp"

#include <cmath>

#include "sil/match/record/statistics/sides.hpp"
#include "sil/match/referee/match_rules.hpp"
#include "sil/world/field_specs.hpp"
#include "sil/world/physics_constants.hpp"

namespace striker::sil {
namespace {

constexpr int shot_ms = 2'000;
constexpr double slowest_shot_m_s = 1.0;
constexpr double widest_shot_m = 0.7;

// How far from the goal's middle a ball that rolls straight on crosses the line of the goal that the team plays at; none
// if it is slow, or does not reach the line in 2 s of roll.
std::optional<double> crossing_m(Vec2 ball, Vec2 velocity_m_s, Team team, int half) {
  const Vec2 own = own_spot(team, half, ball);
  const Vec2 own_velocity = own_spot(team, half, velocity_m_s);
  const double speed_m_s = std::hypot(own_velocity.x, own_velocity.y);
  const double ahead_m = field_half_length_m - own.x;
  if (speed_m_s <= slowest_shot_m_s || own_velocity.x <= 0.0 || ahead_m < 0.0) {
    return {};
  }
  const double reach_m = speed_m_s * (1.0 - std::exp(-damping_per_s * shot_ms / 1e3)) / damping_per_s;
  if (ahead_m * speed_m_s / own_velocity.x > reach_m) {
    return {};
  }
  return std::abs(own.y + ahead_m * own_velocity.y / own_velocity.x);
}

}  // namespace

void Shots::add(const RefereeFrame& seen, const std::array<double, 3>& ball_velocity_m_s, int half,
                MatchFigures& figures) {
  if (save_ && (save_->since_ms += frame_ms) > shot_ms) {
    ++figures.teams[index_of(save_->team)].saves;
    save_.reset();
  }
  if (shot_ && (shot_->since_ms += frame_ms) > shot_ms) {
    shot_.reset();
  }
  if (seen.touching.any()) {
    touched(seen.touching);
  }
  if (const std::optional<Team> team = shot_ ? shot_->team : toucher_) {
    const Vec2 velocity_m_s = {ball_velocity_m_s[0], ball_velocity_m_s[1]};
    if (const auto across_m = crossing_m(seen.ball.position_m, velocity_m_s, *team, half)) {
      aim(*across_m, *team, figures);
    }
  }
}

void Shots::touched(RobotSet touching) {
  toucher_ = only_team_of(touching);
  if (!shot_) {
    return;
  }
  const Team other = opponent_of(shot_->team);
  if ((touching & robots_of(other)).none()) {
    shot_->since_ms = 0;  // the same shot goes on
    toucher_.reset();
    return;
  }
  if (shot_->on_target && touching[robot_of(other, goalkeeper_id)]) {
    save_ = {.team = other};
  }
  shot_.reset();
}

void Shots::aim(double across_m, Team team, MatchFigures& figures) {
  TeamFigures& own = figures.teams[index_of(team)];
  if (!shot_ && across_m < widest_shot_m) {
    ++own.shots;
    shot_ = {.team = team};
    toucher_.reset();
  }
  if (shot_ && !shot_->on_target && across_m < goal_half_width_m) {
    ++own.shots_on_target;
    shot_->on_target = true;
  }
}

void Shots::score(Team team, MatchFigures& figures) {
  if (shot_ && shot_->team != team) {
    shot_.reset();
  }
  aim(0.0, team, figures);
}

void Shots::stop(bool is_goal, MatchFigures& figures) {
  if (save_ && !is_goal) {
    ++figures.teams[index_of(save_->team)].saves;
  }
  *this = {};
}

}  // namespace striker::sil

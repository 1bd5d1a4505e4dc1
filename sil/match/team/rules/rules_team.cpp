// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/rules/rules_team.hpp"

#include "sil/match/referee/match_rules.hpp"
#include "sil/match/team/rules/roles.hpp"
#include "sil/match/team/top_speed.hpp"

namespace striker::sil {

namespace {

constexpr GoToGains kicking_off = {1.4, 3.0, 0.4, false};

SpeedOrder full_ahead(std::size_t id) {
  return {top_speed_m_s(id), top_speed_m_s(id)};
}

}  // namespace

TeamOrders RulesTeam::play(const TeamView& view) {
  const Glimpse now = glimpse_of(view);
  if (view.reset_reason != ResetReason::none || !before_) {
    before_ = now;
  }
  if (view.state == GameState::open_play || view.state == GameState::corner) {
    play_open(view, {.now = now, .before = *before_});
  } else if (view.has_ball) {
    play_set_piece(view);
  }
  before_ = now;
  TeamOrders orders;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    orders[id] = last_[id];
  }
  return orders;
}

void RulesTeam::play_open(const TeamView& view, const Sight& sight) {
  if (!options_.passing || view.state == GameState::corner) {
    play_roles(sight);
    return;
  }
  const auto passing = passing_.play(sight, view.clock_ms / frame_ms);
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    order(id, sight.now.own[id], passing[id] ? *passing[id] : role_action(sight, id));
  }
}

void RulesTeam::play_set_piece(const TeamView& view) {
  if (view.state == GameState::kickoff) {
    order(kicker_id, view.own[kicker_id].pose, GoTo{{0.0, 0.0}, kicking_off});
  } else if (view.state == GameState::goal_kick) {
    last_[goalkeeper_id] = full_ahead(goalkeeper_id);
  } else if (view.state == GameState::penalty) {
    last_[kicker_id] = full_ahead(kicker_id);
  }
}

void RulesTeam::play_roles(const Sight& sight) {
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    order(id, sight.now.own[id], role_action(sight, id));
  }
}

void RulesTeam::order(std::size_t id, const Pose& robot, const Action& action) {
  last_[id] = wheels_of(action, robot, top_speed_m_s(id), options_.reverse);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/team_view.hpp"

#include "sil/match/referee/match_rules.hpp"

namespace striker::sil {

namespace {

bool plays_to_plus_x(Team team, int half) {
  return (team == Team::red) == (half == 1);
}

}  // namespace

TeamView view_of(Team team, const RefereeFrame& seen, const Ruling& ruling) {
  const RefereeFrame own_frame = plays_to_plus_x(team, ruling.half) ? seen : turned(seen);
  const auto robot = [&](Team whose, std::size_t id) {
    const std::size_t number = robot_of(whose, id);
    return RobotView{.pose = own_frame.robots[number],
                     .active = !ruling.locked[number] && !ruling.sent_out[number],
                     .touching = seen.touching[number]};
  };
  const bool stands_still = ruling.state == GameState::pause || ruling.state == GameState::over;
  TeamView view{.clock_ms = ruling.clock_ms,
                .half = ruling.half,
                .sim_ms = ruling.sim_ms + frame_ms,
                .score = {ruling.score[index_of(team)], ruling.score[index_of(opponent_of(team))]},
                .state = stands_still ? GameState::open_play : ruling.state,
                .has_ball = ruling.owner == team,
                .reset_reason = ruling.reset_reason,
                .own = {},
                .opponents = {},
                .ball_m = own_frame.ball.position_m,
                .ball_height_m = own_frame.ball.height_m};
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    view.own[id] = robot(team, id);
    view.opponents[id] = robot(opponent_of(team), id);
  }
  return view;
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/player_watch.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "sil/match/record/statistics/match_statistics.hpp"

namespace striker::sil {

PlayerWatch::PlayerWatch(const std::array<std::string, 2>& names,
                         const std::array<std::unique_ptr<Strategy>, 2>& strategies) {
  for (const Team team : teams) {
    players_[index_of(team)].name = names[index_of(team)];
    players_[index_of(team)].program = dynamic_cast<const TcpStrategy*>(strategies[index_of(team)].get());
  }
}

void PlayerWatch::frame(const MatchFrame& frame) {
  for (const Team team : teams) {
    Player& player = players_[index_of(team)];
    if (player.program == nullptr) {
      continue;
    }
    const auto answered = is_answered(frame, team);
    player.asked += answered ? 1 : 0;
    player.unanswered += answered == false ? 1 : 0;
    const auto why_gone = player.program->why_gone();
    if (why_gone && !player.is_told) {
      player.is_told = true;
      fmt::print(
          stderr,
          "striker-sil: the player program of {} is gone in frame {}: {}; its robots have no orders from here on\n",
          player.name, frame.number, *why_gone);
    }
  }
}

void PlayerWatch::end(const MatchEnd& /*end*/) {
  for (const Player& player : players_) {
    if (player.unanswered > 0) {
      fmt::print(stderr, "striker-sil: {} gave no answer in {} of {} frames\n", player.name,
                 player.unanswered, player.asked);
    }
  }
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Tells on stderr what a person would not see otherwise: that a player program is gone, in which frame and why, and at
// the end in how many frames it gave no answer (TeamFigures::unanswered_frames in match.json).
#pragma once

#include <array>
#include <memory>
#include <string>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/team/strategy.hpp"
#include "sil/match/team/tcp/tcp_strategy.hpp"

namespace striker::sil {

class PlayerWatch final : public MatchObserver {
 public:
  // `strategies` outlive it; those that are no player programs are not looked at.
  PlayerWatch(const std::array<std::string, 2>& names,
              const std::array<std::unique_ptr<Strategy>, 2>& strategies);

  void frame(const MatchFrame& frame) override;
  void end(const MatchEnd& end) override;

 private:
  struct Player {
    std::string name;
    const TcpStrategy* program = nullptr;
    bool is_told = false;  // that it is gone
    int asked = 0;
    int unanswered = 0;
  };

  std::array<Player, 2> players_;
};

}  // namespace striker::sil

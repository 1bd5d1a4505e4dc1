// SPDX-License-Identifier: Apache-2.0
// Kicks that were ordered as a motion, and what became of them: match_figures.hpp says what counts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/statistics/match_figures.hpp"

namespace striker::sil {

class KickCounts {
 public:
  // A frame in which the clock ran.
  void add(const MatchFrame& frame, MatchFigures& figures);
  // Play stopped: no kick goes on.
  void stop() { kicks_ = {}; }

 private:
  struct Kick {
    std::optional<std::uint8_t> number;  // of the motion that goes on
    Vec2 target;                         // in the field frame
    bool met = false;
    Vec2 ball;        // where it was met
    int frames = -1;  // until its way is judged; -1: it is not to be
  };

  static void see_ball(Kick& kick, std::size_t robot, const RefereeFrame& seen, TeamFigures& figures);
  static void see_order(Kick& kick, std::size_t robot, const MatchFrame& frame, TeamFigures& figures);

  std::array<Kick, robots_in_match> kicks_;
};

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Who has the ball, and who passed it on, by touches alone: match_figures.hpp says what counts.
#pragma once

#include <optional>

#include "sil/match/record/statistics/match_figures.hpp"
#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

class Touches {
 public:
  // A frame in which the clock ran.
  void add(const RefereeFrame& seen, MatchFigures& figures);
  // Play stopped: what was touched before counts for nothing after.
  void stop() { *this = {}; }

  // The team in possession.
  [[nodiscard]] std::optional<Team> holder() const { return holder_; }

 private:
  RobotSet touching_;    // in the frame before
  RobotSet last_touch_;  // in the last frame in which anybody did
  std::optional<Team> holder_;
  int since_ms_ = 0;    // the last touch
  double way_m_ = 0.0;  // of the ball since then
  Vec2 ball_;
};

}  // namespace striker::sil

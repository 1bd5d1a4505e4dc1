// SPDX-License-Identifier: Apache-2.0
// Shots and saves: match_figures.hpp says what counts.
#pragma once

#include <array>
#include <optional>

#include "sil/match/record/statistics/match_figures.hpp"
#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

class Shots {
 public:
  // A frame in which the clock ran.
  void add(const RefereeFrame& seen, const std::array<double, 3>& ball_velocity_m_s, int half,
           MatchFigures& figures);
  // After `add` of the same frame: this team scored, and it was no own goal.
  void score(Team team, MatchFigures& figures);
  // Play stopped. A ball that the goalkeeper held off until then was saved, unless it is a goal.
  void stop(bool is_goal, MatchFigures& figures);

 private:
  struct Shot {
    Team team;
    bool on_target = false;
    int since_ms = 0;  // the team's last touch
  };
  struct Save {
    Team team;
    int since_ms = 0;
  };

  void touched(RobotSet touching);
  void aim(double across_m, Team team, MatchFigures& figures);

  std::optional<Team> toucher_;  // whose touch may become a shot
  std::optional<Shot> shot_;     // on its way
  std::optional<Save> save_;     // if it does not go in
};

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// A short match that has something of everything.
#pragma once

#include "tests/match/record/recorded_match.hpp"

namespace striker::sil {

// Two halves of 10 s: red scores, an out, a robot that falls, a deadlock; then nothing, to the end.
inline MatchRules short_rules() {
  MatchRules rules = official();
  rules.half_ms = 10'000;
  return rules;
}

inline void play_short_match(RecordedMatch& play) {
  play.robots[3].set_points_m_s = {1.25, -0.5};
  play.robots[3].order_age_ms = 20;
  play.open_play();
  play.ball(3.6, 0.25, {2.0, 0.5});
  play.touched_by({red(3)});
  play.ball(3.95, 0.3, {2.0, 0.5});
  play.step();  // a goal
  play.run_until_play();
  play.ball(0.7, 0.0);
  play.step();
  play.ball(1.0, -2.4);
  play.touched_by({blue(2)});  // out
  play.run_until_play();
  play.match.frame.standing.reset(red(1));
  play.touched_by({red(4), blue(0)});
  play.run(3'500);  // robot 1 falls
  while (play.match.ruling().state != GameState::over) {
    play.match.frame.ball.speed_m_s = 0.0;
    play.step();
  }
}

}  // namespace striker::sil

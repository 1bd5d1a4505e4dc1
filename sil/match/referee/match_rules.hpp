// SPDX-License-Identifier: Apache-2.0
// The rules of a match, as a value: every limit and every deviation stands here and nowhere else. A rule set is
// changed by changing a copy:
//
//   MatchRules rules = official();
//   rules.half_ms = 60'000;
//
// Source of all figures: AI World Cup test_world, branch master 37312a93 (2019-08-06, "v0.7"), its constants and its
// supervisor; lengths of the field are in areas.hpp. `published()` is that referee. `official()` differs from it by
// the switches at the end, each of which mends something that the published one does to itself.
#pragma once

#include "firmware/core/tick.hpp"

namespace striker::sil {

// The referee sees one frame of an AI Soccer match after another; a player decides as often.
inline constexpr int frame_ms = core::decision_period_ms;

struct MatchRules {
  // Times are multiples of a frame, at least one frame and at most `longest_rule_ms`. Those of play count on the
  // half's clock, which stands still in a pause; those of pauses count in simulated time.
  int half_ms = 300'000;

  int goal_pause_ms = 3'000;  // from a goal until all are placed for the kickoff
  int stop_pause_ms = 1'000;  // from any other stop until all, or the ball alone, are placed
  int half_pause_ms = 3'000;  // after a half, and after the match
  int settle_ms = 1'000;      // from a placement until the clock runs

  int set_piece_ms = 3'000;     // then all may move, whatever the kicker did
  int fallen_ms = 3'000;        // without having been seen standing: sent out
  int sent_out_ms = 5'000;      // then back, as soon as play is open and the home spot free
  int goal_area_ms = 1'000;     // in the opponent's goal area: sent home, and the own goalkeeper sent out
  int keeper_away_ms = 3'000;   // a goalkeeper outside of its own penalty area: sent home
  int deadlock_ms = 4'000;      // of a slow ball in open play
  double slow_ball_m_s = 0.4;   // a ball is slow below it, in space
  double kickoff_ball_m = 0.5;  // from the centre: a ball beyond it ends the kickoff
  double clearance_m = 0.225;   // a spot is free if no centre is nearer: 1.5 times a robot's side
  int most_defenders = 3;       // in a penalty area with the ball, beside it too: one more is a penalty kick
  int most_attackers = 2;       // likewise: one more is a goal kick

  bool deadlock = true;  // off in training: a slow ball stays where it is

  // Whoever was sent out during a set piece stays out when it ends. Published: "may not move now" and "was sent out"
  // are one flag, so that the end of a set piece frees who stands outside, and the next frame sends it out anew.
  bool own_flag_for_sent_out = true;
  // The ball is dropped on the nearest free spot (free_spot.hpp). Published: on its spot, whoever stands there.
  bool drop_on_free_spot = true;

  bool operator==(const MatchRules&) const = default;
};

[[nodiscard]] constexpr MatchRules official() {
  return {};
}

[[nodiscard]] constexpr MatchRules published() {
  MatchRules rules;
  rules.own_flag_for_sent_out = false;
  rules.drop_on_free_spot = false;
  return rules;
}

inline constexpr int longest_rule_ms = 86'400'000;

// Whether every time is one that a referee can count, and every length and speed is positive.
[[nodiscard]] constexpr bool are_sound(const MatchRules& rules) {
  for (const int time_ms : {rules.half_ms, rules.goal_pause_ms, rules.stop_pause_ms, rules.half_pause_ms,
                            rules.settle_ms, rules.set_piece_ms, rules.fallen_ms, rules.sent_out_ms,
                            rules.goal_area_ms, rules.keeper_away_ms, rules.deadlock_ms}) {
    if (time_ms < frame_ms || time_ms > longest_rule_ms || time_ms % frame_ms != 0) {
      return false;
    }
  }
  return rules.slow_ball_m_s > 0.0 && rules.kickoff_ball_m > 0.0 && rules.clearance_m > 0.0 &&
         rules.most_defenders >= 0 && rules.most_attackers >= 0;
}

static_assert(are_sound(official()) && are_sound(published()));

}  // namespace striker::sil

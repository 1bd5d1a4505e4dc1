// SPDX-License-Identifier: Apache-2.0
// The figures of a match: everything that is counted, as whole numbers or sums, from which reports make shares and
// means. What counts as what stands here.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/core/state.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/match/referee/event.hpp"

namespace striker::sil {

// That a team got, by what stopped play.
struct SetPieces {
  int after_out = 0;
  int after_crowding = 0;
  int after_deadlock = 0;

  [[nodiscard]] int total() const { return after_out + after_crowding + after_deadlock; }
};

// A touch is a contact of a robot's body with the ball within a frame. Where only one team can be meant, a frame in
// which both touched is nobody's.
struct TeamFigures {
  int goals = 0;      // those that count for it, own goals of the opponent too
  int own_goals = 0;  // that count for the opponent

  // Frames in which the team was asked and the referee let one of its robots move; and those of them in which it ordered
  // none of these: a player program that was late, silent, gone, or said nonsense.
  int asked_frames = 0;
  int unanswered_frames = 0;

  // The clock runs, and it was this team that touched last, at most 3 s ago.
  int possession_ms = 0;
  // One of its robots, not sent out, has the ball: AI Soccer's rule of 2020. Their centres are nearer than 0.125 m and
  // 0.13 s times their relative speed (at least 0.5 m/s), the ball is within 45 degrees of the heading, and their
  // heights are within 10 mm.
  int control_ms = 0;
  int attacking_third_ms = 0;  // the ball is beyond 1.3 m, while the clock runs
  // A touch by one of the team, the next touch by another of it within 3 s, and a way of the ball of more than 0.3 m
  // between them.
  int passes = 0;
  int penalty_area_entries = 0;  // the ball comes into the opponent's penalty area, in this team's possession

  // A shot: after a touch by the team the ball is faster than 1.0 m/s, and rolling straight on it meets the
  // opponent's goal line within 2 s and 0.7 m of the goal's middle; on target: 0.5 m. It lasts until an opponent touches
  // the ball, play stops, or for 2 s from the team's last touch; all touches within it are one shot. A goal of the
  // team's own is a shot on target, however slow.
  int shots = 0;
  int shots_on_target = 0;
  // The opponent's shot on target is next touched by the goalkeeper, and is not in within 2 s.
  int saves = 0;

  // Kicks that the team ordered as a motion of the controller; those in which that robot touched the ball; and of these
  // the ones whose ball, 100 ms later, has gone within 15 degrees of where the order meant it to go.
  int kicks = 0;
  int kicks_met = 0;
  int kicks_as_meant = 0;

  // The goalkeeper while the clock runs and it is not out: its distance from its goal line, and how far it is beside
  // the ball's y (as far as the goal's mouth goes). Sums over frames.
  double keeper_line_sum_m = 0.0;
  double keeper_lag_sum_m = 0.0;
  int keeper_frames = 0;

  SetPieces goal_kicks;
  SetPieces corners;
  SetPieces penalties;

  int fallen = 0;            // sent out for it
  int left_field = 0;        // sent out for it
  int keeper_sent_out = 0;   // for a team mate in the opponent's goal area; those that were out already too
  int sent_home = 0;         // from the opponent's goal area
  int keeper_sent_home = 0;  // from outside of its penalty area
  int out_ms = 0;            // of robots that were sent out, summed, while the clock ran
};

inline constexpr int status_period_ms =
    10;  // the message table's; sil/match/play/match_robot.cpp holds it to it

// A controller drives its robot if it says so: by its last status it is active, and that came at most two of its periods
// ago. One that is dead, off the bus or not heard drives nobody, whatever it said last.
[[nodiscard]] constexpr bool is_driven(const RobotRecord& robot) {
  return robot.state == core::State::active && robot.status_age_ms <= 2 * status_period_ms;
}

// Of a robot and its controller. "While it may play": the clock runs, and it is neither locked nor sent out.
struct RobotFigures {
  int touches = 0;                    // that began
  double way_m = 0.0;                 // of its centre, while it may play
  int play_frames = 0;                // while it may play
  int undriven_ms = 0;                // see is_driven, while it may play
  std::int64_t order_age_sum_ms = 0;  // over frames with an order, while it may play
  int order_frames = 0;
  int order_age_max_ms = 0;
  int saturated_ticks = 0;                                // while it may play
  int lost_frames = 0;                                    // on its bus, in pauses too: lost, late or altered
  std::array<int, core::fault_names.size()> faults = {};  // that began, in pauses too
};

struct MatchFigures {
  std::array<int, 2> score = {};
  int half = 1;
  int clock_ms = 0;  // of that half
  std::int64_t frames = 0;
  std::int64_t sim_ms = 0;
  std::array<int, game_state_names.size()> state_ms = {};  // spent in each state
  int middle_third_ms = 0;                                 // the ball is, while the clock runs
  int deadlocks = 0;
  int drops = 0;  // of these: the ball alone was placed
  std::array<TeamFigures, 2> teams;
  std::array<RobotFigures, robots_in_match> robots;

  // In open play and set pieces.
  [[nodiscard]] int played_ms() const {
    int sum_ms = 0;
    for (const GameState state : {GameState::open_play, GameState::kickoff, GameState::goal_kick,
                                  GameState::corner, GameState::penalty}) {
      sum_ms += state_ms[static_cast<std::size_t>(state)];
    }
    return sum_ms;
  }
};

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What the ball does to play: step 7 of a frame.
#include <cmath>

#include "sil/match/referee/areas.hpp"
#include "sil/match/referee/formations.hpp"
#include "sil/match/referee/referee.hpp"

namespace striker::sil {
namespace {

Cause line_of(Vec2 ball) {
  if (beyond_end_line(ball)) {
    return Cause::end_line;
  }
  return beyond_side_line(ball) ? Cause::side_line : Cause::corner_cut;
}

// Who of the owner ends a set piece by a touch.
RobotSet enders_of(GameState set_piece, Team owner) {
  if (set_piece == GameState::kickoff) {
    return {};
  }
  return set_piece == GameState::corner ? robots_of(owner) : RobotSet().set(kicker_of(set_piece, owner));
}

ResetReason reason_of(GameState set_piece) {
  switch (set_piece) {
    case GameState::goal_kick:
      return ResetReason::goal_kick;
    case GameState::corner:
      return ResetReason::corner_kick;
    case GameState::penalty:
      return ResetReason::penalty_kick;
    default:
      return ResetReason::deadlock;
  }
}

}  // namespace

void Referee::judge_set_piece() {
  ball_fast_ms_ = ruling_.clock_ms;
  const Vec2 ball = seen_.ball.position_m;
  const int lasted_ms = ruling_.clock_ms - set_piece_since_ms_;
  const bool is_touched = (seen_.touching & enders_of(ruling_.state, *ruling_.owner)).any();
  const bool has_left = ruling_.state == GameState::kickoff &&
                        ball.x * ball.x + ball.y * ball.y > rules_.kickoff_ball_m * rules_.kickoff_ball_m;
  if (lasted_ms < rules_.set_piece_ms && !is_touched && !has_left) {
    return;
  }
  MatchEvent& event = tell(EventKind::set_piece_over, is_touched ? Cause::touch
                                                      : has_left ? Cause::ball_left
                                                                 : Cause::time);
  event.team = ruling_.owner;
  event.set_piece = ruling_.state;
  event.timer_ms = lasted_ms;
  ruling_.state = GameState::open_play;
  ruling_.owner.reset();
  ruling_.locked.reset();
  if (!rules_.own_flag_for_sent_out) {
    ruling_.sent_out.reset();
  }
}

void Referee::judge_open_play() {
  if (judge_goal() || judge_out()) {
    return;
  }
  return_robots();
  if (!judge_crowding() && rules_.deadlock) {
    judge_deadlock();
  }
}

bool Referee::judge_goal() {
  const Vec2 ball = seen_.ball.position_m;
  if (!in_a_goal(ball)) {
    return false;
  }
  const Team conceding = defenders_at(ball);
  const Team scoring = opponent_of(conceding);
  ++ruling_.score[index_of(scoring)];
  MatchEvent& event =
      tell(EventKind::goal, touched_alone(conceding, last_touch_) ? Cause::own_goal : Cause::scored);
  event.team = scoring;
  event.set_piece = GameState::kickoff;
  event.counts = count_touches(last_touch_).robots;
  event.exit_m = in_field_frame(exit_point(ball_before_, ball));
  stop(rules_.goal_pause_ms,
       {.next = GameState::kickoff,
        .owner = conceding,
        .cause = Cause::after_goal,
        .reason = scoring == Team::red ? ResetReason::red_scored : ResetReason::blue_scored,
        .ball = ball});
  return true;
}

bool Referee::judge_out() {
  const Vec2 ball = seen_.ball.position_m;
  if (!is_out(ball)) {
    return false;
  }
  const Team defenders = defenders_at(ball);
  const Count touches = count_touches(last_touch_);
  const Team owner = owner_after_out(touches, defenders);
  MatchEvent& event = tell(EventKind::ball_out, line_of(ball));
  event.counts = touches.robots;
  event.exit_m = in_field_frame(exit_point(ball_before_, ball));
  stop_with(event, owner == defenders ? GameState::goal_kick : GameState::corner, owner, Cause::after_out);
  return true;
}

bool Referee::judge_crowding() {
  const Vec2 ball = seen_.ball.position_m;
  if (!ball_in_a_penalty_area(ball)) {
    return false;
  }
  const Team defenders = defenders_at(ball);
  const Team attackers = opponent_of(defenders);
  const Count there = count_in_penalty_strip(seen_, active());
  const bool by_defenders = there.of(defenders) > rules_.most_defenders;
  if (!by_defenders && there.of(attackers) <= rules_.most_attackers) {
    return false;
  }
  MatchEvent& event = tell(EventKind::crowding, by_defenders ? Cause::defenders : Cause::attackers);
  event.counts = there.robots;
  stop_with(event, by_defenders ? GameState::penalty : GameState::goal_kick,
            by_defenders ? attackers : defenders, Cause::after_crowd);
  return true;
}

void Referee::judge_deadlock() {
  const int slow_ms = ruling_.clock_ms - ball_fast_ms_;
  if (seen_.ball.speed_m_s >= rules_.slow_ball_m_s) {
    ball_fast_ms_ = ruling_.clock_ms;
  } else if (slow_ms >= rules_.deadlock_ms) {
    const Vec2 ball = seen_.ball.position_m;
    const bool at_an_end = std::abs(ball.x) > penalty_line_m;
    const bool in_the_middle = std::abs(ball.y) < penalty_half_width_m;
    deadlock_at(!at_an_end      ? Cause::elsewhere
                : in_the_middle ? Cause::penalty_area
                                : Cause::corner_area,
                slow_ms);
  }
}

void Referee::deadlock_at(Cause where, int timer_ms) {
  MatchEvent& event = tell(EventKind::deadlock, where);
  event.timer_ms = timer_ms;
  if (where == Cause::elsewhere) {
    return stop(rules_.stop_pause_ms, {.next = GameState::open_play,
                                       .cause = Cause::drop,
                                       .reason = ResetReason::deadlock,
                                       .ball = seen_.ball.position_m});
  }
  const bool in_area = where == Cause::penalty_area;
  const Team defenders = defenders_at(seen_.ball.position_m);
  const Count there = in_area ? count_in_penalty_strip(seen_, active()) : count_in_corner(seen_, active());
  const Team owner = owner_after_deadlock(there, defenders);
  event.counts = there.robots;
  event.distances_m = there.distances_m;
  const GameState kick = owner == defenders ? GameState::goal_kick : GameState::penalty;
  stop_with(event, in_area ? kick : GameState::corner, owner, Cause::after_lock);
}

void Referee::stop_with(MatchEvent& event, GameState set_piece, Team owner, Cause after) {
  event.team = owner;
  event.set_piece = set_piece;
  stop(rules_.stop_pause_ms, {.next = set_piece,
                              .owner = owner,
                              .cause = after,
                              .reason = reason_of(set_piece),
                              .ball = seen_.ball.position_m});
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// The referee of an AI Soccer match: a state machine over what a frame of 50 ms shows. It knows no world, no bus and
// no clock of its own, so that a match, a test, a fuzzer or a log can step it. Same frames, same rulings, to the bit;
// a copy goes on by itself. A step of a referee that is no copy allocates nothing.
//
//   Referee referee(official());
//   follow(referee.ruling());                 // the opening: all placed for the kickoff
//   while (referee.ruling().state != GameState::over) {
//     play_for_50_ms();                       // wheels of robots that may not move are told 0
//     follow(referee.step(what_is_seen()));   // place what is placed, at rest; log the events
//   }
//
// Every step is one frame of simulated time, in pauses too: there bodies still roll, but the referee only counts.
// What a player of AI Soccer is told with a frame is the ruling of the frame before.
//
// A match: opening, settle, first half, pause, ends changed, settle, second half, pause, over. Simulated time is the
// clock of both halves and, with the published figures, 1 s at the start, 4 s at half-time, 3 s at the end, 4 s for a
// goal and 2 s for any other stop.
//
// Order of a frame in play. The first thing that stops play ends it.
//   1 clock    + 50 ms. A half whose time is up is over before any rule: a ball in the goal by then does not count.
//   2 touch    if anybody touched the ball, those who did, of both teams, are its last touch
//   3 fallen   may move, and not seen standing for 3 s before this frame, whether it stands now or not: sent out
//   4 field    may move, and its centre has left the field: sent out
//   5 goals    anybody 1 s in the opponent's goal area, its home spot free: sent home, and its goalkeeper is sent out
//   6 keepers  may move, 3 s out of its own penalty area and goal, its home spot free: sent home
//   7 state    a set piece, by its own limits only, or open play: goal; else out; returns; crowding; deadlock
// A test that finds a home spot taken waits, and asks again in the next frame. A body that was placed in a frame is
// where it was placed for the tests that follow; but whether a home spot is free is asked of the frame as it was
// shown, so that it matters to neither colour that red's robots are judged first.
//
//   set piece   who may move     over after 3 s, or as soon as
//   kickoff     robot 4          the ball is more than 0.5 m from the centre
//   goal kick   the goalkeeper   the goalkeeper touches the ball
//   corner      robot 4          any robot of the owner does
//   penalty     robot 4          robot 4 does
//
// From a stop to play: a pause; then all are placed, whoever was out plays again and the last touch is forgotten; or
// the ball alone is dropped, and nothing else changes; then all settle, and the clock runs on.
#pragma once

#include <array>
#include <optional>

#include "sil/match/referee/match_rules.hpp"
#include "sil/match/referee/ownership.hpp"
#include "sil/match/referee/referee_frame.hpp"
#include "sil/match/referee/ruling.hpp"

namespace striker::sil {

class Referee {
 public:
  // Throws std::invalid_argument if the rules are not sound. The first ruling is the opening.
  explicit Referee(const MatchRules& rules = official());

  // The frame 50 ms after the one before, or after the opening. The reference holds until the next step. A match that
  // is over stays as it is.
  const Ruling& step(const RefereeFrame& frame);

  [[nodiscard]] const Ruling& ruling() const { return ruling_; }
  [[nodiscard]] const MatchRules& rules() const { return rules_; }

 private:
  // Why play stands still, and how it goes on.
  struct Stop {
    GameState next = GameState::kickoff;  // open_play: the ball is dropped. over: it does not go on.
    Team owner = Team::red;
    Cause cause = Cause::half_start;
    ResetReason reason = ResetReason::game_start;
    Vec2 ball = {};  // when play stopped
  };

  // Time and stops (referee.cpp).
  void play();
  void end_half();
  void stop(int pause_ms, const Stop& how);
  void wait();
  void restart();
  void place_all();
  void drop_ball();
  void resume();

  // Steps 3 to 6, and returns (referee_robots.cpp).
  void check_fallen();
  void check_field();
  void check_goal_areas();
  void check_keepers();
  void return_robots();
  void send_out(std::size_t robot, Cause cause, int timer_ms);
  void send_home(std::size_t robot, Cause cause, int timer_ms);
  void place(std::size_t robot, const Pose& own_spot);
  [[nodiscard]] bool is_home_free(std::size_t robot) const;
  [[nodiscard]] Vec2 own_position(std::size_t robot) const;

  // Step 7 (referee_ball.cpp). Each says whether it stopped play.
  void judge_set_piece();
  void judge_open_play();
  bool judge_goal();
  bool judge_out();
  bool judge_crowding();
  void judge_deadlock();
  void deadlock_at(Cause where, int timer_ms);
  void stop_with(MatchEvent& event, GameState set_piece, Team owner, Cause after);

  // With clocks, score, ball and last touch as they are.
  MatchEvent& tell(EventKind kind, Cause cause);

  [[nodiscard]] RobotSet active() const { return ~(ruling_.locked | ruling_.sent_out); }
  [[nodiscard]] Vec2 in_field_frame(Vec2 spot) const;
  [[nodiscard]] Pose in_field_frame(const Pose& pose) const;

  MatchRules rules_;
  Ruling ruling_;  // its flags, clocks and state are the referee's own

  // In red's frame, as everything below: so no rule knows of halves.
  RefereeFrame seen_;                             // what was placed since: where it was placed
  std::array<Vec2, robots_in_match> shown_ = {};  // robots, before anything was placed
  Vec2 ball_before_;
  RobotSet last_touch_;

  Stop stop_;            // in a pause
  bool placed_ = false;  // in a pause: what is left of it is for settling

  // When, on the half's clock, something was so last.
  std::array<int, robots_in_match> stood_ms_ = {};
  std::array<int, robots_in_match> out_of_goal_area_ms_ = {};
  std::array<int, 2> keeper_home_ms_ = {};
  int ball_fast_ms_ = 0;
  // Since when a robot is out. It may outlast the flag where the rules have but one (match_rules.hpp).
  std::array<std::optional<int>, robots_in_match> out_since_ms_;
  int set_piece_since_ms_ = 0;

  std::uint32_t next_seq_ = 0;
};

}  // namespace striker::sil

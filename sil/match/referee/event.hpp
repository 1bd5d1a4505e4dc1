// SPDX-License-Identifier: Apache-2.0
// What a referee decided, once for each decision, with everything that it decided by: a log of them explains a match.
// An event is an edge. What lasts (a pause, a robot that is out) stands in the ruling.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sil/match/referee/referee_frame.hpp"

namespace striker::sil {

// `pause`: the clock stands, nobody may move. `over`: the match is, for good.
enum class GameState : std::uint8_t { open_play, kickoff, goal_kick, corner, penalty, pause, over };

inline constexpr std::array<std::string_view, 7> game_state_names = {
    "open_play", "kickoff", "goal_kick", "corner", "penalty", "pause", "over"};

[[nodiscard]] constexpr std::string_view name_of(GameState state) {
  return game_state_names[static_cast<std::size_t>(state)];
}

[[nodiscard]] constexpr bool is_set_piece(GameState state) {
  return state == GameState::kickoff || state == GameState::goal_kick || state == GameState::corner ||
         state == GameState::penalty;
}

enum class EventKind : std::uint8_t {
  goal,            // the score has changed
  ball_out,        // the ball left the field
  crowding,        // too many in a penalty area with the ball
  deadlock,        // the ball was slow for too long
  half_over,       // the first half's time is up
  match_over,      // the second's
  restart,         // all were placed, or the ball alone (cause `drop`)
  resumed,         // the clock runs again
  set_piece_over,  // everybody who is not out may move
  sent_out,        // a robot is out
  out_anew,        // a goalkeeper that is out is out for longer
  sent_home,       // a robot was put on its home spot, and plays on
  returned,        // a robot that was out plays again, from its home spot
};

inline constexpr std::array<std::string_view, 13> event_kind_names = {
    "goal",    "ball_out",       "crowding", "deadlock", "half_over", "match_over", "restart",
    "resumed", "set_piece_over", "sent_out", "out_anew", "sent_home", "returned"};

[[nodiscard]] constexpr std::string_view name_of(EventKind kind) {
  return event_kind_names[static_cast<std::size_t>(kind)];
}

enum class Cause : std::uint8_t {
  scored,        // goal
  own_goal,      // goal: the last to touch the ball were of the conceding team alone
  end_line,      // ball_out: by this line
  side_line,     // ball_out
  corner_cut,    // ball_out
  defenders,     // crowding: by these
  attackers,     // crowding
  penalty_area,  // deadlock: there
  corner_area,   // deadlock
  elsewhere,     // deadlock: the ball is dropped
  time,          // half_over, match_over, set_piece_over, returned: a time is up
  half_start,    // restart, resumed
  after_goal,    // restart, resumed
  after_out,     // restart, resumed
  after_crowd,   // restart, resumed
  after_lock,    // restart, resumed: after a deadlock, with a set piece
  drop,          // restart, resumed: after a deadlock, the ball alone was placed
  touch,         // set_piece_over: the ball was played
  ball_left,     // set_piece_over: the ball left the centre circle
  fallen,        // sent_out
  left_field,    // sent_out
  goal_area,  // sent_home: stood in the opponent's goal area. sent_out, out_anew: the goalkeeper's team mate did
  keeper_away,  // sent_home
};

inline constexpr std::array<std::string_view, 23> cause_names = {
    "scored",     "own_goal",     "end_line",    "side_line",  "corner_cut", "defenders",
    "attackers",  "penalty_area", "corner_area", "elsewhere",  "time",       "half_start",
    "after_goal", "after_out",    "after_crowd", "after_lock", "drop",       "touch",
    "ball_left",  "fallen",       "left_field",  "goal_area",  "keeper_away"};

[[nodiscard]] constexpr std::string_view name_of(Cause cause) {
  return cause_names[static_cast<std::size_t>(cause)];
}

// Where the ball is put, at rest.
struct BallPlacement {
  Vec2 position_m;
  double height_m = 0.0;  // of its centre

  bool operator==(const BallPlacement&) const = default;
};

// Figures of both teams are red's and blue's, in this order. Places are in the field frame.
struct MatchEvent {
  std::uint32_t seq = 0;  // 0, 1, 2, ... over the match
  EventKind kind = EventKind::restart;
  Cause cause = Cause::half_start;

  std::int64_t sim_ms = 0;  // simulated time since the match began, pauses included
  int half = 1;
  int clock_ms = 0;               // of the half
  std::array<int, 2> score = {};  // with this event

  // goal: scored. Events of a robot: its own. half_over: kicks off. Stops, restarts, set pieces: has the ball.
  std::optional<Team> team;
  std::optional<std::size_t> robot;        // 0 to 9
  std::optional<GameState> set_piece;      // that follows, or began, or is over
  RobotSet last_touch;                     // who touched the ball in the last frame in which anybody did
  std::array<int, 2> counts = {};          // of robots, where numbers decided: touching, or in the area
  std::array<double, 2> distances_m = {};  // summed over those in the area to the ball, where they may decide
  int timer_ms = 0;                        // that reached its limit
  BallSeen ball;                           // as it was seen
  std::optional<Vec2> exit_m;              // where the ball's way met the field's edge: goal, ball_out
  std::optional<Pose> robot_placement;
  std::optional<BallPlacement> ball_placement;
  bool spot_was_taken = false;  // the placement is not the rule's own spot, but the nearest free one
};

}  // namespace striker::sil

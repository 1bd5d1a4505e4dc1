// SPDX-License-Identifier: Apache-2.0
// What holds after a frame, and what somebody who runs the match has to do about it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sil/match/referee/event.hpp"

namespace striker::sil {

// Why play stopped, as players of AI Soccer are told; the numbers are those of its messages.
enum class ResetReason : std::uint8_t {
  none = 0,
  game_start = 1,  // the start of either half
  red_scored = 2,
  blue_scored = 3,
  game_end = 4,
  deadlock = 5,
  goal_kick = 6,
  corner_kick = 7,
  penalty_kick = 8,
  half_time = 9,
};

// Exact spots, without jitter, in the field frame; every placed body is at rest.
struct Placements {
  std::array<std::optional<Pose>, robots_in_match> robots;
  std::optional<BallPlacement> ball;

  bool operator==(const Placements&) const = default;
};

struct Ruling {
  std::array<int, 2> score = {};  // red's, blue's
  int half = 1;                   // 1 or 2
  int clock_ms = 0;               // of the half: 0 to half_ms
  std::int64_t sim_ms = 0;        // simulated time so far
  GameState state = GameState::pause;
  std::optional<Team> owner;  // in a set piece alone: who plays the ball

  RobotSet locked;    // may not move until the set piece is over
  RobotSet sent_out;  // stands in its slot until it returns
  int pause_ms = 0;   // what is left until the next placement or until the clock runs; 0 out of pauses

  // In one ruling each: half_time and game_end when the time is up, all others when the clock begins to run again.
  ResetReason reset_reason = ResetReason::none;

  // Of this frame alone.
  Placements placements;
  std::vector<MatchEvent> events;

  // Whether a robot's orders count. If not, its wheels are told to stand still.
  [[nodiscard]] bool may_move(std::size_t robot) const {
    return state != GameState::pause && state != GameState::over && !locked[robot] && !sent_out[robot];
  }
};

}  // namespace striker::sil

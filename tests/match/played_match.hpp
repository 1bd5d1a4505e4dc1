// SPDX-License-Identifier: Apache-2.0
// A match on paper: nothing moves but what a test moves, and what the referee places is where it says.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sil/match/referee/formations.hpp"
#include "sil/match/referee/referee.hpp"

namespace striker::sil {

// What somebody who runs the match does with placements.
inline void follow(const Ruling& ruling, RefereeFrame& frame) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (const auto& placement = ruling.placements.robots[robot]) {
      frame.robots[robot] = *placement;
      frame.standing.set(robot);
    }
  }
  if (const auto& placement = ruling.placements.ball) {
    frame.ball = {.position_m = placement->position_m, .height_m = placement->height_m};
  }
}

struct PlayedMatch {
  explicit PlayedMatch(const MatchRules& rules = official()) : referee(rules) {
    log = referee.ruling().events;
    follow(referee.ruling(), frame);
  }

  const Ruling& ruling() const { return referee.ruling(); }

  // One frame as it stands; touches are of that frame alone.
  const Ruling& step() {
    const Ruling& result = referee.step(frame);
    follow(result, frame);
    frame.touching.reset();
    log.insert(log.end(), result.events.begin(), result.events.end());
    return result;
  }
  void run(int time_ms) {
    for (int ran_ms = 0; ran_ms < time_ms; ran_ms += frame_ms) {
      step();
    }
  }
  void run_until_play() {
    while (ruling().state == GameState::pause) {
      step();
    }
  }
  // Into open play as soon as a kickoff allows it: 50 ms of the clock. The ball is fast then, at (0.6, 0).
  void open_play() {
    run_until_play();
    ball(0.6, 0.0);
    step();
  }

  void ball(double x_m, double y_m, double speed_m_s = 1.0) {
    frame.ball = {.position_m = {x_m, y_m}, .speed_m_s = speed_m_s};
  }
  void put(std::size_t robot, double x_m, double y_m) { frame.robots[robot] = {x_m, y_m, 0.0}; }
  void touch(std::size_t robot) { frame.touching.set(robot); }

  [[nodiscard]] std::size_t count(EventKind kind) const {
    return static_cast<std::size_t>(std::ranges::count(log, kind, &MatchEvent::kind));
  }
  // The newest of its kind; one that never happens if there was none.
  [[nodiscard]] MatchEvent last(EventKind kind) const {
    for (auto event = log.rbegin(); event != log.rend(); ++event) {
      if (event->kind == kind) {
        return *event;
      }
    }
    MatchEvent none;
    none.kind = kind;
    none.clock_ms = -1;
    return none;
  }

  Referee referee;
  RefereeFrame frame;
  std::vector<MatchEvent> log;
};

inline constexpr std::size_t red(std::size_t id) {
  return robot_of(Team::red, id);
}
inline constexpr std::size_t blue(std::size_t id) {
  return robot_of(Team::blue, id);
}

}  // namespace striker::sil

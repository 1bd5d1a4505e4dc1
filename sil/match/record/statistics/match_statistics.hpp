// SPDX-License-Identifier: Apache-2.0
// Makes the figures of a match (match_figures.hpp) from its frames, without files: the same frames give the same
// figures.
//
//   MatchStatistics statistics;
//   statistics.add(frame);  // each frame, in order, pauses too
//   report(statistics.figures());
#pragma once

#include <array>
#include <optional>

#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/statistics/kick_counts.hpp"
#include "sil/match/record/statistics/match_figures.hpp"
#include "sil/match/record/statistics/shots.hpp"
#include "sil/match/record/statistics/touches.hpp"

namespace striker::sil {

// Whether a team ordered any robot that the referee lets move in this frame; none: it was not asked, or none may move.
[[nodiscard]] std::optional<bool> is_answered(const MatchFrame& frame, Team team);

class MatchStatistics {
 public:
  void add(const MatchFrame& frame);

  [[nodiscard]] const MatchFigures& figures() const { return figures_; }

 private:
  void add_play(const MatchFrame& frame);
  void add_places(const RefereeFrame& seen, int half);
  void add_keepers(const RefereeFrame& seen, int half);
  void add_control(const MatchFrame& frame);
  void add_robots(const MatchFrame& frame);
  void add_controllers(const MatchFrame& frame);
  void add_answers(const MatchFrame& frame);
  void add_events(const Ruling& ruling);
  void add_stop(const MatchEvent& event);
  void add_robot_event(const MatchEvent& event);

  TeamFigures& of(Team team) { return figures_.teams[index_of(team)]; }

  MatchFigures figures_;
  Touches touches_;
  Shots shots_;
  KickCounts kicks_;

  // By the frame before: what held while this frame's 50 ms went by.
  GameState state_ = GameState::pause;
  RobotSet locked_;
  RobotSet sent_out_;
  std::array<Pose, robots_in_match> placed_ = {};  // where the robots were then, after placements
  std::array<bool, 2> ball_in_area_ = {};          // that the team attacks
  std::array<core::Fault, robots_in_match> faults_ = {};
};

}  // namespace striker::sil

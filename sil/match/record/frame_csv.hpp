// SPDX-License-Identifier: Apache-2.0
// frames.csv: what red's player sees of a match, frame by frame, in the 57 columns of the public data set of AI Soccer
// games (SAMMiCA/Scenario3-AISoccer, its README), so that both are read alike. Red is "own", in both halves:
//
//   frame                                     number of the frame; 50 ms each. Pauses are gaps, as no player sees them
//   game_state                                0 open play, 1 kickoff, 2 goal kick, 3 corner kick, 4 penalty kick
//   friction                                  of tyres on the floor: 3.0
//   ball_pos_0 to _2                          x, y, height, m
//   robot_0_wheel_speed_0 to robot_4_..._1    left and right rim set-points of red's robots, m/s
//   robot_0_cur_pos_0 to robot_4_..._2        red's robots: x, y, height of the body's centre, m
//   robot_0_cur_pos_opp_0 to robot_4_..._2    blue's
//   robot_0_active to robot_4_active          True or False: neither locked by a set piece nor sent out
//   robot_0_active_opp to robot_4_active_opp  blue's
//   episode_id                                0, 1, 2, ...: frames without a gap in the same game_state
//
// Places are in red's own frame: x to blue's goal. Headings are not in the data set; match.log.gz has them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware/host/atomic_file.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/match/team/team_view.hpp"

namespace striker::sil {

// Written to a temporary file, renamed at the end. Throws std::runtime_error that names the file.
class FrameCsv final : public MatchObserver {
 public:
  explicit FrameCsv(const std::filesystem::path& file) : file_(file) {}

  void begin(const MatchHeader& header) override;
  void frame(const MatchFrame& frame) override;
  void end(const MatchEnd& /*end*/) override { file_.finish(); }

 private:
  void write_row(const MatchFrame& frame, const TeamView& view);

  host::AtomicFile file_;
  Ruling told_;  // by the frame before, without its events: what a player is told with a frame
  std::int64_t last_frame_ = -1;
  GameState last_state_ = GameState::pause;
  int episode_ = -1;
};

}  // namespace striker::sil

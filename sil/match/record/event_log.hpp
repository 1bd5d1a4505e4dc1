// SPDX-License-Identifier: Apache-2.0
// events.jsonl: every ruling of the referee once, a line of JSON each, after one line that tells of the match.
//
// The first line: record ("striker match events"), format (1), then header_json (match_json.hpp), then version,
// git_hash and build_type of the program. The others, with these keys in this order:
//
//   seq              0, 1, 2, ...
//   t_sim_ns         simulated time since the match began, pauses included
//   half, clock_ms   the clock of the half
//   frame            the number of the frame that it was decided by
//   event, cause     by their names in sil/match/referee/event.hpp
//   team             whose it is: who scored; a robot's own; else as owner
//   owner            who has the ball next; null if that was not decided
//   robot            0 to 9; null: of none
//   set_piece        that follows, or began, or is over; null: none
//   score            [red's, blue's], with this event
//   last_touch       the robots that touched the ball in the last frame in which any did
//   ball             position_m [x, y], height_m, velocity_m_s [x, y, z], speed_m_s: as seen, or as placed
//   exit_m           [x, y] where the ball's way met the field's edge, or null
//   counts           robots that decided, [red's, blue's]
//   distances_m      to the ball, summed, where they may decide, [red's, blue's]
//   timer_ms         that reached its limit; 0: none
//   robot_placement  [x, y, heading], or null
//   ball_placement   [x, y, height], or null
//   spot_was_taken   the placement is the nearest free spot, not the rule's own
//
// Places are in the field frame, in metres and radians. No wall-clock time is in it: same match, same bytes.
#pragma once

#include <filesystem>

#include "firmware/host/atomic_file.hpp"
#include "sil/match/record/match_frame.hpp"

namespace striker::sil {

// Written as FILE.part, renamed at the end. Each line is handed to the kernel at once: a match that is killed or fails
// leaves all of them in FILE.part. Throws std::runtime_error that names the file.
class EventLog final : public MatchObserver {
 public:
  explicit EventLog(const std::filesystem::path& file) : file_(file, host::Unfinished::kept) {}

  void begin(const MatchHeader& header) override;
  void frame(const MatchFrame& frame) override;
  void end(const MatchEnd& /*end*/) override { file_.finish(); }

 private:
  host::AtomicFile file_;
};

}  // namespace striker::sil

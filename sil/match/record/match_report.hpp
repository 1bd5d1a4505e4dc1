// SPDX-License-Identifier: Apache-2.0
// match.json: the result of a match and every statistic. Keys, in this order:
//
//   record, format   "striker match", 1
//   complete         false: it was interrupted, and everything below is of what was played
//   state_hash       16 hexadecimal digits: the same match run again ends with the same
//   (header_json)    as in events.jsonl (match_json.hpp)
//   result           score [red's, blue's]; winner: "red", "blue", "draw", or null if incomplete
//   flow             frames; sim_s; half and clock_s at the end; played_s: the clock ran; dead_s: it did not;
//                    in_play_share; state_s: by the names of states; middle_third_share of played_s; deadlocks, and
//                    drops of these; deadlocks_per_10_min of played_s
//   red, blue        of each team:
//     name, goals, own_goals (for the opponent)
//     orders         asked_frames, unanswered_frames: those in which it ordered nobody
//     ball           possession_s, possession_share (of both teams'), control_s, control_share (likewise),
//                    attacking_third_share of played_s, touches, passes, penalty_area_entries
//     attack         shots, shots_on_target, conversion (goals that are no own goals of the opponent, a shot), kicks,
//                    kicks_met, kicks_as_meant, kicks_as_meant_share of those met
//     keeper         saves, line_m and lag_m (means)
//     goal_kicks, corners, penalties
//                    that it got: total, after_out, after_crowding, after_deadlock
//     discipline     sent_out: all; fallen, left_field, keeper_sent_out: by cause; sent_home, keeper_sent_home; out_s
//     firmware       order_age_mean_ms, order_age_max_ms, saturation_share of ticks, lost_frames, faults, undriven_s
//   robots           of each of the ten: team, id, touches, way_m, play_s, then the keys of firmware, with faults by
//                    name
//   version, git_hash, build_type
//
// What a share or mean is of may be nothing: it is null then. What counts as what: statistics/match_figures.hpp. No
// wall-clock time is in it: same match, same bytes. Those figures are in timing.json (match_records.hpp).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "firmware/host/atomic_file.hpp"
#include "sil/match/record/match_frame.hpp"
#include "sil/match/record/statistics/match_statistics.hpp"

namespace striker::sil {

[[nodiscard]] nlohmann::ordered_json match_json(const MatchHeader& header, const MatchFigures& figures,
                                                const MatchEnd& end);

// Written to a temporary file, renamed at the end. Throws std::runtime_error that names the file.
class MatchReport final : public MatchObserver {
 public:
  explicit MatchReport(const std::filesystem::path& file) : file_(file) {}

  void begin(const MatchHeader& header) override { header_ = header; }
  void frame(const MatchFrame& frame) override { statistics_.add(frame); }
  void end(const MatchEnd& end) override;

  [[nodiscard]] const MatchFigures& figures() const { return statistics_.figures(); }

 private:
  host::AtomicFile file_;
  MatchHeader header_;
  MatchStatistics statistics_;
};

}  // namespace striker::sil

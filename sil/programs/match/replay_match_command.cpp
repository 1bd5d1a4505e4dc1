// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/replay_match_command.hpp"

#include <fmt/format.h>

#include "firmware/core/tick.hpp"
#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/match/record/match_report.hpp"
#include "sil/match/replay/match_replay.hpp"
#include "sil/match/replay/recorded_plan.hpp"
#include "sil/programs/replay_command.hpp"

namespace striker::sil {

namespace {

struct Figures final : MatchObserver {
  void frame(const MatchFrame& frame) override { statistics.add(frame); }
  MatchStatistics statistics;
};

void tell(const ReplayDifference& difference) {
  fmt::print("tick {}, frame {}, robot {}: recorded {}, now {}\n", difference.tick,
             difference.tick / core::decision_period_ticks, difference.robot,
             difference.recorded.empty() ? "nothing" : difference.recorded,
             difference.now.empty() ? "nothing" : difference.now);
}

}  // namespace

int play_match_again(const std::filesystem::path& directory) {
  const RecordedMatch recorded = read_match(directory / "match.json");
  Figures figures;
  const std::array<MatchObserver*, 1> records = {&figures};
  const MatchReplay again = replay_match(recorded.plan, recorded.frames, directory / "bus",
                                         links_in_process(), records, host::stop_requested);
  if (again.difference) {
    tell(*again.difference);
    return exit_differs;
  }
  if (host::stop_requested()) {
    return host::exit_interrupted;
  }
  fmt::print("{} frames on ten buses, all as recorded; state {:016x}\n", again.frames, again.end.state_hash);
  if (again.end.state_hash != recorded.end.state_hash) {
    fmt::print("but the match ended in state {:016x}\n", recorded.end.state_hash);
    return exit_differs;
  }
  const auto now = match_json(recorded.plan.header, figures.statistics.figures(),
                              {.complete = recorded.end.complete, .state_hash = again.end.state_hash});
  if (const auto other = first_other_value(directory / "match.json", now)) {
    fmt::print("but in match.json {}\n", *other);
    return exit_differs;
  }
  return 0;
}

}  // namespace striker::sil

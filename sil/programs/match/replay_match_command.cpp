// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/replay_match_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "firmware/core/tick.hpp"
#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/host/temporary_directory.hpp"
#include "sil/match/record/match_records.hpp"
#include "sil/match/replay/match_replay.hpp"
#include "sil/match/replay/record_comparison.hpp"
#include "sil/match/replay/recorded_plan.hpp"
#include "sil/programs/replay_command.hpp"

namespace striker::sil {

namespace {

void tell(const ReplayDifference& difference) {
  fmt::print("tick {}, frame {}, robot {}: recorded {}, now {}\n", difference.tick,
             difference.tick / core::decision_period_ticks, difference.robot,
             difference.recorded.empty() ? "nothing" : difference.recorded,
             difference.now.empty() ? "nothing" : difference.now);
}

}  // namespace

int play_match_again(const std::filesystem::path& directory) {
  const RecordedMatch recorded = read_match(directory / "match.json");
  const host::TemporaryDirectory now;
  const auto files = match_records(now.path());
  std::vector<MatchObserver*> records;
  std::ranges::transform(files, std::back_inserter(records), &std::unique_ptr<MatchObserver>::get);
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
  if (const auto other = first_other_record(directory, now.path())) {
    fmt::print("but {}\n", *other);
    return exit_differs;
  }
  fmt::print("match.json, events.jsonl, frames.csv and match.log.gz, all as recorded\n");
  return 0;
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// All records of a match, in one directory:
//
//   match.json     result and statistics (match_report.hpp)
//   events.jsonl   each ruling once (event_log.hpp)
//   frames.csv     what red's player sees, as the public data set has it (frame_csv.hpp)
//   match.log.gz   SSL game log (ssl/ssl_log.hpp)
//   timing.json    wall-clock figures, of this one run: apart, so that all others are the same bytes for the same match
//
//   auto records = match_records("out/match");
//   for (auto& record : records) { record->begin(header); }  // then frame(...) each, then end(...)
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "sil/match/record/match_frame.hpp"

namespace striker::sil {

// Makes the directory if it is missing. All files are begun at once, and are there at the end. Throws
// std::runtime_error that names the directory or file.
[[nodiscard]] std::vector<std::unique_ptr<MatchObserver>> match_records(
    const std::filesystem::path& directory);

struct MatchTiming {
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

// timing.json in this directory: simulated_s, wall_s, realtime_factor.
void write_timing(const MatchTiming& timing, const std::filesystem::path& directory);

}  // namespace striker::sil

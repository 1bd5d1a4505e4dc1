// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/match_records.hpp"

#include <nlohmann/json.hpp>

#include "firmware/host/files.hpp"
#include "sil/match/record/event_log.hpp"
#include "sil/match/record/frame_csv.hpp"
#include "sil/match/record/match_report.hpp"
#include "sil/match/record/ssl/ssl_log.hpp"

namespace striker::sil {

std::vector<std::unique_ptr<MatchObserver>> match_records(const std::filesystem::path& directory) {
  host::require_writable(directory);
  std::vector<std::unique_ptr<MatchObserver>> records;
  records.push_back(std::make_unique<EventLog>(directory / "events.jsonl"));
  records.push_back(std::make_unique<FrameCsv>(directory / "frames.csv"));
  records.push_back(std::make_unique<MatchReport>(directory / "match.json"));
  records.push_back(std::make_unique<SslLog>(directory / "match.log.gz"));
  return records;
}

void write_timing(const MatchTiming& timing, const std::filesystem::path& directory) {
  const double factor = timing.wall_s > 0.0 ? timing.simulated_s / timing.wall_s : 0.0;
  const nlohmann::ordered_json report = {
      {"simulated_s", timing.simulated_s}, {"wall_s", timing.wall_s}, {"realtime_factor", factor}};
  host::write_file(directory / "timing.json", report.dump(1) + '\n');
}

}  // namespace striker::sil

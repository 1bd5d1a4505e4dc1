// The ceiling and its rivals over the episodes of a seed, and what is reported of them. Results depend on the
// options alone, never on the number of jobs.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sil/task/kick_report.hpp"
#include "training/ceiling/ceiling.hpp"
#include "training/ceiling/rivals.hpp"

namespace striker::training {

struct CeilingOptions {
  std::uint64_t seed = 0;
  int episodes = 0;  // numbers 0 and up, as in striker-evaluate and striker-sil
  sil::PoseMode pose = sil::PoseMode::origin;
  World replay = World::fast;  // where the found actions, and the rivals, are played
  bool rivals = false;
  int jobs = 1;
  LineGrid grid = {};
};

struct CeilingEpisode {
  Ceiling ceiling;
  sil::KickOutcome best_replay;
  sil::KickOutcome safe_replay;
  std::array<sil::KickOutcome, all_rivals.size()> rivals;
};

// Searches and plays every episode. Calls `progress` in this thread, with the episodes that are done; false
// from it stops the run. Returns all episodes, or none if it was stopped.
[[nodiscard]] std::vector<CeilingEpisode> run_ceiling(const CeilingOptions& options,
                                                      const Reachable& reachable,
                                                      const std::function<bool(int done)>& progress);

[[nodiscard]] std::string ceiling_table(const CeilingOptions& options,
                                        const std::vector<CeilingEpisode>& episodes);
[[nodiscard]] std::string ceiling_json(const CeilingOptions& options,
                                       const std::vector<CeilingEpisode>& episodes);
// A row an episode, with the found actions as letters: forward, stop, backward.
[[nodiscard]] std::string ceiling_csv(const CeilingOptions& options,
                                      const std::vector<CeilingEpisode>& episodes);

}  // namespace striker::training

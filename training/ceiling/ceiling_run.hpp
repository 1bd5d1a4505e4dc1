// SPDX-License-Identifier: Apache-2.0
// The ceiling and its rivals over the episodes of a seed. Results depend on the options alone, never on the
// number of jobs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "training/ceiling/rivals.hpp"
#include "training/search/ceiling.hpp"

namespace striker::training {

struct CeilingOptions {
  std::uint64_t seed = 0;
  int episodes = 0;  // numbers 0 and up, as in striker-evaluate and striker-sil
  sil::PoseMode pose = sil::PoseMode::origin;
  sil::KickReward reward = sil::KickReward::contact;
  Physics replay = Physics::planar;  // where the found actions, and the rivals, are played
  bool rivals = false;
  int jobs = 1;
  LineGrid grid = {};  // that of the reachable states, whose robot replays and rivals have
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

}  // namespace striker::training

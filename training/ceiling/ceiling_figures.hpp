// SPDX-License-Identifier: Apache-2.0
// The figures of a run of the ceiling: what its table and its JSON say.
#pragma once

#include <string>
#include <vector>

#include "sil/task/kick_report.hpp"
#include "sil/task/mean_estimate.hpp"
#include "training/ceiling/ceiling_run.hpp"

namespace striker::training {

// How one way to play did.
struct NamedSummary {
  std::string name;
  sil::KickSummary summary;
};

struct CeilingFigures {
  sil::MeanEstimate ceiling;      // the reward that was found, an episode
  double contact_possible = 0.0;  // share of the episodes in which any actions make a contact
  double found_again = 0.0;       // share in which the replay makes the contact that was found
  // What was found, replayed: the best, the best off the edges, the better of the two in each episode.
  std::vector<NamedSummary> replays;
  std::vector<NamedSummary> rivals;  // in the order of Rival; none if they were not asked for
};

[[nodiscard]] CeilingFigures ceiling_figures(const CeilingOptions& options,
                                             const std::vector<CeilingEpisode>& episodes);

// The share of the way from no contact (-4) to the ceiling.
[[nodiscard]] double score(double mean_reward, double ceiling);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/ceiling_figures.hpp"

#include <algorithm>
#include <cmath>

namespace striker::training {

namespace {

// The better of the two replays.
const sil::KickOutcome& bound_of(const CeilingEpisode& episode) {
  return episode.safe_replay.reward > episode.best_replay.reward ? episode.safe_replay : episode.best_replay;
}

bool as_found(const FoundSequence& found, const sil::KickOutcome& replay) {
  return found.contact_step < 0 ? !replay.contact
                                : replay.contact_decision == found.contact_step / steps_per_decision &&
                                      std::abs(replay.reward - found.reward) < 0.01;
}

sil::MeanEstimate ceiling_mean(const std::vector<CeilingEpisode>& episodes) {
  std::vector<double> rewards;
  rewards.reserve(episodes.size());
  for (const CeilingEpisode& episode : episodes) {
    rewards.push_back(episode.ceiling.best.reward);
  }
  return sil::mean_estimate(rewards);
}

double contact_possible(const std::vector<CeilingEpisode>& episodes) {
  const auto possible = std::ranges::count_if(
      episodes, [](const CeilingEpisode& episode) { return episode.ceiling.best.contact_step >= 0; });
  return static_cast<double>(possible) / static_cast<double>(episodes.size());
}

double found_again(const std::vector<CeilingEpisode>& episodes) {
  const auto count = std::ranges::count_if(episodes, [](const CeilingEpisode& episode) {
    return as_found(episode.ceiling.best, episode.best_replay);
  });
  return static_cast<double>(count) / static_cast<double>(episodes.size());
}

template <typename OutcomeOf>
sil::KickSummary summary_of(const std::vector<CeilingEpisode>& episodes, const OutcomeOf& outcome_of) {
  std::vector<sil::KickOutcome> outcomes;
  outcomes.reserve(episodes.size());
  for (const CeilingEpisode& episode : episodes) {
    outcomes.push_back(outcome_of(episode));
  }
  return sil::kick_summary(outcomes);
}

sil::KickSummary rival_summary(const std::vector<CeilingEpisode>& episodes, Rival rival) {
  return summary_of(episodes, [rival](const CeilingEpisode& episode) {
    return episode.rivals.at(static_cast<std::size_t>(rival));
  });
}

std::vector<NamedSummary> replay_rows(const std::vector<CeilingEpisode>& episodes) {
  return {{"best", summary_of(episodes, [](const CeilingEpisode& episode) { return episode.best_replay; })},
          {"safe", summary_of(episodes, [](const CeilingEpisode& episode) { return episode.safe_replay; })},
          {"better", summary_of(episodes, bound_of)}};
}

std::vector<NamedSummary> rival_rows(const CeilingOptions& options,
                                     const std::vector<CeilingEpisode>& episodes) {
  std::vector<NamedSummary> rows;
  for (const Rival rival : all_rivals) {
    if (options.rivals) {
      rows.push_back({std::string(name_of(rival)), rival_summary(episodes, rival)});
    }
  }
  return rows;
}

}  // namespace

CeilingFigures ceiling_figures(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  return {.ceiling = ceiling_mean(episodes),
          .contact_possible = contact_possible(episodes),
          .found_again = found_again(episodes),
          .replays = replay_rows(episodes),
          .rivals = rival_rows(options, episodes)};
}

double score(double mean_reward, double ceiling) {
  return (mean_reward - no_contact_reward) / (ceiling - no_contact_reward);
}

}  // namespace striker::training

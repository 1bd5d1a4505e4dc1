// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/summary_markdown.hpp"

#include <fmt/format.h>

#include <cmath>

namespace striker::training {

namespace {

// Without the sign of what rounds to 0.
double hundredths(double value) {
  return std::abs(value) < 0.005 ? 0.0 : value;
}

}  // namespace

std::string figure(const Estimate& estimate) {
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", hundredths(estimate.value), hundredths(estimate.interval.low),
                     hundredths(estimate.interval.high));
}

std::string figure(const Crossing& crossing, int runs) {
  const std::string reached =
      crossing.reached == runs ? std::string() : fmt::format(", {} of {} runs", crossing.reached, runs);
  const auto episode = [&crossing](double value) {
    return value < crossing.never ? fmt::format("{:.0f}", value) : std::string("never");
  };
  if (crossing.reached == 0) {
    return "never";
  }
  return fmt::format("{} [{}, {}]{}", episode(crossing.episode.value), episode(crossing.episode.interval.low),
                     episode(crossing.episode.interval.high), reached);
}

std::string summary_markdown(const std::vector<VariantSummary>& summaries, double ceiling) {
  std::string text = fmt::format(
      "Interquartile means over {} seeds with 95 % bootstrap intervals; episodes until the moving average of 250 "
      "exceeds a level are medians. 50 % and 90 %: of the way from -4 to the ceiling of {:.3f}. Origin and anywhere: "
      "greedy play on {} held-out episodes. P: the probability that a run of the first variant ends with the better "
      "mean over its last 1,000 episodes.\n\n"
      "| variant | to -4 | to 0 | to 50 % | to 90 % | best average | last 1,000 | origin | anywhere | lost anywhere | P |"
      "\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      summaries.front().runs, ceiling, evaluation_episodes);
  for (const VariantSummary& s : summaries) {
    text += fmt::format("| {} |", s.variant->says);
    for (const Crossing& crossing : s.crossings) {
      text += fmt::format(" {} |", figure(crossing, s.runs));
    }
    for (const Estimate& estimate :
         {s.best, s.final_mean, s.origin_mean, s.anywhere_mean, s.loss, s.behind_first}) {
      text += fmt::format(" {} |", figure(estimate));
    }
    text += '\n';
  }
  return text;
}

}  // namespace striker::training

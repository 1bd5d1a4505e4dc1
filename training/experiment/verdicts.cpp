// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "training/experiment/summary_markdown.hpp"

namespace striker::training {

namespace {

// Null if none has it.
const VariantSummary* summary_of(const std::vector<VariantSummary>& summaries, const std::string& name) {
  const auto found = std::find_if(summaries.begin(), summaries.end(),
                                  [&name](const VariantSummary& s) { return s.variant->name == name; });
  return found == summaries.end() ? nullptr : &*found;
}

}  // namespace

std::string claims_table(const std::vector<VariantSummary>& summaries) {
  const VariantSummary& rcs = summaries.front();
  const VariantSummary* wide = summary_of(summaries, "rcs+4");
  std::string text = "| the paper, one run each | found | holds |\n|---|---|---|\n";
  const double to_floor = rcs.crossings[0].episode.value;
  text += fmt::format("| RCS exceeds -4 from about episode 1,500 | from episode {} | {} |\n",
                      figure(rcs.crossings[0], rcs.runs),
                      std::abs(to_floor - 1500.0) < 250.0 ? "yes" : "no: random play is already above -4");
  if (wide != nullptr) {
    const auto delay = [&](std::size_t level) {
      return wide->crossings[level].episode.value - rcs.crossings[level].episode.value;
    };
    text += fmt::format(
        "| about 500 episodes before the ACS-sized state | {:.0f} episodes earlier to -4, {:.0f} to 0, {:.0f} to 50 % | {} |\n",
        delay(0), delay(1), delay(2),
        delay(1) > 250.0 && delay(2) > 250.0 ? "yes"
        : delay(1) > 0.0 && delay(2) > 0.0   ? "earlier, by less"
                                             : "no");
  }
  const auto best = std::max_element(summaries.begin(), summaries.end(), [](const auto& a, const auto& b) {
    return a.best.value < b.best.value;
  });
  text += fmt::format("| RCS has the best value, 6.8 | {} for RCS; the best is {} with {} | {} |\n",
                      figure(rcs.best), best->variant->says, figure(best->best),
                      best->variant == rcs.variant                        ? "yes"
                      : best->best.interval.low <= rcs.best.interval.high ? "not to be told apart"
                                                                          : "no");
  return text;
}

std::string readings_table(const std::vector<VariantSummary>& summaries) {
  constexpr double paper_crossing = 1500.0;
  // In units of what one would still call similar: a reward of 1, 500 episodes.
  const auto distance = [](const VariantSummary& s) {
    const double start = std::max(0.0, s.start.value - floor_reward);
    return start + std::abs(s.crossings[0].episode.value - paper_crossing) / 500.0 +
           std::abs(s.best.value - paper_best_reward);
  };
  std::string text =
      "The paper: below -4 at first, above it from about episode 1,500, best 6.8. Distance: how far the first average "
      "is above -4, plus the crossing's distance in 500 episodes, plus the best value's distance.\n\n"
      "| reading | first average | above -4 from | best average | distance |\n|---|---|---|---|---|\n";
  double least = std::numeric_limits<double>::infinity();
  std::string closest;
  for (const VariantSummary& s : summaries) {
    text += fmt::format("| {} | {} | {} | {} | {:.2f} |\n", s.variant->says, figure(s.start),
                        figure(s.crossings[0], s.runs), figure(s.best), distance(s));
    if (distance(s) < least) {
      least = distance(s);
      closest = s.variant->says;
    }
  }
  return text + fmt::format("\nClosest: {} (distance {:.2f}).\n", closest, least);
}

}  // namespace striker::training

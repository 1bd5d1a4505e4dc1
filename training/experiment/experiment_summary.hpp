// SPDX-License-Identifier: Apache-2.0
// What an experiment's runs say together. All runs must be complete; the same runs give the same bytes.
#pragma once

#include <array>
#include <vector>

#include "training/experiment/experiment.hpp"
#include "training/experiment/statistics.hpp"

namespace striker::training {

inline constexpr double floor_reward = -4.0;  // of an episode without contact

// A figure of a variant over its seeds.
struct Estimate {
  double value = 0.0;
  Interval interval;  // bootstrap, 95 %
};

// When the moving average (full windows of 250 only) first exceeds a level.
struct Crossing {
  Estimate episode;  // median over the seeds; a run that never does counts as its last episode + 1
  int reached = 0;   // runs that do
  double never = 0;  // the last episode + 1
};

inline constexpr int crossing_levels = 4;  // -4, 0, 50 % and 90 % of the way from the floor to the ceiling

struct CurvePoint {
  int episode = 0;
  Estimate moving_average;  // interquartile mean
};

struct VariantSummary {
  const Variant* variant = nullptr;
  int runs = 0;
  std::array<Crossing, crossing_levels> crossings;
  // Interquartile means over the seeds.
  Estimate start;          // first full moving average
  Estimate best;           // greatest moving average
  Estimate final_mean;     // of the last 1,000 episodes' rewards
  Estimate origin_mean;    // greedy, held-out episodes at the origin
  Estimate anywhere_mean;  // the same episodes, the robot anywhere
  Estimate loss;           // origin minus anywhere, run by run
  Estimate behind_first;   // probability that a run of the first variant has the better final mean
  std::vector<CurvePoint> curve;
};

// The runs of each variant, in the order of the variants; `ceiling` is the best mean reward possible.
[[nodiscard]] std::vector<VariantSummary> summarise_variants(const std::vector<Variant>& variants,
                                                             const std::vector<std::vector<RunFigures>>& runs,
                                                             double ceiling);

}  // namespace striker::training

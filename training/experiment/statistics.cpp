// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sil/world/random.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::training {

namespace {

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> copy(values.begin(), values.end());
  std::sort(copy.begin(), copy.end());
  return copy;
}

}  // namespace

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::span<const double> values, double share) {
  const std::vector<double> ordered = sorted(values);
  const double at = share * static_cast<double>(ordered.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(at));
  const std::size_t above = std::min(below + 1, ordered.size() - 1);
  return std::lerp(ordered[below], ordered[above], at - static_cast<double>(below));
}

double interquartile_mean(std::span<const double> values) {
  const std::vector<double> ordered = sorted(values);
  const std::size_t cut = ordered.size() / 4;
  return mean(std::span(ordered).subspan(cut, ordered.size() - 2 * cut));
}

Interval bootstrap_interval(const std::vector<std::vector<double>>& strata,
                            const std::function<double(const std::vector<std::vector<double>>&)>& statistic,
                            std::uint64_t seed) {
  sil::Random random(seed, 0, sil::random_stream::bootstrap);
  std::vector<std::vector<double>> drawn = strata;
  std::vector<double> statistics;
  statistics.reserve(bootstrap_draws);
  for (int draw = 0; draw < bootstrap_draws; ++draw) {
    for (std::size_t s = 0; s < strata.size(); ++s) {
      for (double& value : drawn[s]) {
        value = strata[s][random.below(strata[s].size())];
      }
    }
    statistics.push_back(statistic(drawn));
  }
  return {.low = quantile(statistics, 0.025), .high = quantile(statistics, 0.975)};
}

Interval interquartile_interval(const std::vector<double>& values, std::uint64_t seed) {
  return bootstrap_interval(
      {values}, [](const auto& drawn) { return interquartile_mean(drawn[0]); }, seed);
}

double probability_of_improvement(std::span<const double> better, std::span<const double> worse) {
  double above = 0.0;
  for (const double b : better) {
    for (const double w : worse) {
      const double tie = b == w ? 0.5 : 0.0;
      above += b > w ? 1.0 : tie;
    }
  }
  return above / static_cast<double>(better.size() * worse.size());
}

Interval improvement_interval(const std::vector<double>& better, const std::vector<double>& worse,
                              std::uint64_t seed) {
  return bootstrap_interval(
      {better, worse}, [](const auto& drawn) { return probability_of_improvement(drawn[0], drawn[1]); },
      seed);
}

}  // namespace striker::training

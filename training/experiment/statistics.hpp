// SPDX-License-Identifier: Apache-2.0
// Statistics over a few independent runs, as Agarwal et al. 2021 ("Deep Reinforcement Learning at the Edge of
// the Statistical Precipice") recommend: interquartile means, bootstrap intervals over runs, and the
// probability of improvement. Everything is a pure function of its arguments, the seed of the draws included.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace striker::training {

// The sum over the count: in the last digit another number than sil::mean_estimate, which reports of episodes
// give.
[[nodiscard]] double mean(std::span<const double> values);

// Linear between the sorted values; share 0 is the least, 1 the greatest.
[[nodiscard]] double quantile(std::span<const double> values, double share);

// The mean of the middle half: of n values the lowest and the greatest floor(n / 4) are left out.
[[nodiscard]] double interquartile_mean(std::span<const double> values);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

inline constexpr int bootstrap_draws = 2000;

// The 95 % percentile interval of a statistic, each stratum resampled with replacement by itself.
[[nodiscard]] Interval bootstrap_interval(
    const std::vector<std::vector<double>>& strata,
    const std::function<double(const std::vector<std::vector<double>>&)>& statistic, std::uint64_t seed);

// Of one sample's interquartile mean.
[[nodiscard]] Interval interquartile_interval(const std::vector<double>& values, std::uint64_t seed);

// How often a run of `better` is above one of `worse`, over all pairs; ties count half.
[[nodiscard]] double probability_of_improvement(std::span<const double> better,
                                                std::span<const double> worse);
[[nodiscard]] Interval improvement_interval(const std::vector<double>& better,
                                            const std::vector<double>& worse, std::uint64_t seed);

}  // namespace striker::training

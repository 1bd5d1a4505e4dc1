// SPDX-License-Identifier: Apache-2.0
// Statistics over runs: against their definitions, and what an interval promises.
#include "training/experiment/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sil/world/random.hpp"

namespace striker::training {
namespace {

using Values = std::vector<double>;

Values some_values(std::uint64_t seed, int count) {
  sil::Random random(seed, 0, 0);
  Values values;
  for (int i = 0; i < count; ++i) {
    values.push_back(random.uniform() + random.uniform() + random.uniform());
  }
  return values;
}

TEST(Statistics, QuantilesRunFromTheLeastToTheGreatest) {
  const Values values = {3.0, 1.0, 2.0, 5.0, 4.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 1.0), 5.0);
  EXPECT_NEAR(quantile(values, 0.1), 1.4, 1e-12);
  EXPECT_EQ(quantile(Values{7.0}, 0.3), 7.0);
}

TEST(Statistics, TheInterquartileMeanIgnoresTheTails) {
  EXPECT_EQ(interquartile_mean(Values{-1e9, 1.0, 2.0, 1e9}), 1.5);
  EXPECT_EQ(interquartile_mean(Values{1.0, 2.0, 6.0}), 3.0);  // a quarter of three is nobody
  Values values(100);
  std::iota(values.begin(), values.end(), 0.0);
  EXPECT_EQ(interquartile_mean(values), 49.5);
}

TEST(Statistics, ImprovementCountsPairs) {
  EXPECT_EQ(probability_of_improvement(Values{2.0, 3.0}, Values{1.0, 0.0}), 1.0);
  EXPECT_EQ(probability_of_improvement(Values{1.0, 3.0}, Values{2.0, 2.0}), 0.5);
  EXPECT_EQ(probability_of_improvement(Values{1.0}, Values{1.0}), 0.5);
}

TEST(Statistics, TheSameSeedGivesTheSameInterval) {
  const Values values = some_values(1, 10);
  const Interval a = interquartile_interval(values, 5);
  const Interval b = interquartile_interval(values, 5);
  const Interval c = interquartile_interval(values, 6);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_NE(a.low, c.low);
  EXPECT_LT(a.low, interquartile_mean(values));
  EXPECT_GT(a.high, interquartile_mean(values));
}

// Of many samples, about 95 % of the intervals hold the true mean: fewer with as few as 20 values, as is
// known of the percentile bootstrap.
TEST(Statistics, AnIntervalHoldsTheTruthAboutAsOftenAsItSays) {
  int held = 0;
  constexpr int samples = 200;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Interval interval = interquartile_interval(some_values(i, 20), i);
    held += interval.low < 1.5 && 1.5 < interval.high ? 1 : 0;
  }
  EXPECT_GT(held, samples * 85 / 100);
  EXPECT_LT(held, samples);
}

// Each stratum is drawn from itself alone.
TEST(Statistics, StrataDoNotMix) {
  const Interval interval = bootstrap_interval(
      {{1.0, 1.0, 1.0}, {2.0, 2.0}}, [](const auto& drawn) { return mean(drawn[1]) - mean(drawn[0]); }, 1);
  EXPECT_EQ(interval.low, 1.0);
  EXPECT_EQ(interval.high, 1.0);
}

}  // namespace
}  // namespace striker::training

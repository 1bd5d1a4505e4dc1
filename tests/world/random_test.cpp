// SPDX-License-Identifier: Apache-2.0
#include "sil/world/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace striker::sil {
namespace {

// Worked out with big integers in Python from the published SplitMix64.
TEST(Random, GivesTheSameBitsEverywhere) {
  Random random(1, 2, 3);
  EXPECT_EQ(random.next(), 0x214d4c07ecfeaac5U);
  EXPECT_EQ(random.next(), 0x6ff419cb83dfe1e6U);
  EXPECT_EQ(random.next(), 0xf475ff91157f0556U);
}

TEST(Random, NeighbouringStreamsShareNothing) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t index = 0; index < 10; ++index) {
      for (std::uint64_t tag = 0; tag < 10; ++tag) {
        Random random(seed, index, tag);
        for (int i = 0; i < 5; ++i) {
          seen.insert(random.next());
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), 5000U);
}

// Five standard deviations of a uniform draw's mean.
TEST(Random, UniformFillsItsRange) {
  constexpr int count = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random(5, i, 0);
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_NEAR(squares / count, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / count));
}

TEST(Random, BelowIsEven) {
  Random random(6, 0, 0);
  std::array<int, 3> counts{};
  for (int i = 0; i < 30'000; ++i) {
    ++counts.at(random.below(3));
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 10'000, 5.0 * std::sqrt(30'000 * 2.0 / 9.0));
  }
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// A random stream that is a pure function of (seed, index, tag): SplitMix64 (Steele, Lea, Flood: "Fast
// splittable pseudorandom number generators", OOPSLA 2014), which walks a 64-bit counter by a fixed odd step
// and mixes it. Streams of different indices or tags are independent for every practical purpose, so that
// episode i needs none of the episodes before it, and a new kind of draw disturbs no other.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace striker::sil {

class Random {
 public:
  constexpr Random(std::uint64_t seed, std::uint64_t index, std::uint64_t tag)
      : state_(mix(mix(mix(seed + step) + index + step) + tag + step)) {}

  [[nodiscard]] constexpr std::uint64_t next() { return mix(state_ += step); }

  // Where the stream stands, and a stream that goes on from there: for checkpoints.
  [[nodiscard]] constexpr std::uint64_t state() const { return state_; }
  constexpr void resume(std::uint64_t state) { state_ = state; }

  // Uniform in [0, 1): the upper 53 bits, so that every value is exact.
  [[nodiscard]] constexpr double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  // Uniform from low to high.
  [[nodiscard]] constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }

  // Uniform in 0 to count - 1, count <= 2^32: multiply and shift; the bias is below count / 2^32.
  [[nodiscard]] constexpr std::uint64_t below(std::uint64_t count) {
    return ((next() >> 32U) * count) >> 32U;
  }

 private:
  static constexpr std::uint64_t step = 0x9E3779B97F4A7C15;

  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EB;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

// From the normal distribution with mean 0 and standard deviation 1 (Box and Muller 1958); two draws.
[[nodiscard]] inline double normal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

}  // namespace striker::sil

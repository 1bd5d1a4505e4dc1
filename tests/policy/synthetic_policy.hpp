// SPDX-License-Identifier: Apache-2.0
// Networks that no training made, for kernels: of any shape, drawn by the compiler from a seed, with weights
// as great as the proof lets them be and scales from one end of their ranges to the other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/policy/policy.hpp"

namespace striker::policy {

class SmallRandom {
 public:
  constexpr explicit SmallRandom(std::uint32_t seed) : state_(seed * 2654435769U + 1) {}
  // xorshift32 (Marsaglia 2003).
  constexpr std::uint32_t bits() {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 17U;
    state_ ^= state_ << 5U;
    return state_;
  }
  constexpr std::int32_t within(std::int32_t limit) {
    const auto span = 2 * static_cast<std::uint32_t>(limit) + 1;
    return static_cast<std::int32_t>(bits() % span) - limit;
  }

 private:
  std::uint32_t state_;
};

template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr void draw_layer(SmallRandom& random, Layer<Inputs, Outputs, Weight>& layer, std::uint8_t shift) {
  // sum |w| * 32767 + |bias| + rounding stays below 2^31 where sum |w| is at most 64000.
  const auto limit =
      static_cast<std::int32_t>(std::min<std::size_t>(std::numeric_limits<Weight>::max(), 64000 / Inputs));
  for (auto& row : layer.weights) {
    for (Weight& weight : row) {
      weight = static_cast<Weight>(random.bits() % 8 == 0 ? (random.bits() % 2 == 0 ? limit : -limit)
                                                          : random.within(limit));
    }
  }
  for (std::int32_t& bias : layer.biases) {
    bias = random.within(20'000'000);
  }
  layer.shift = shift;
}

template <class Policy>
constexpr Policy synthetic_policy_of(std::uint32_t seed) {
  SmallRandom random(seed);
  Policy policy{};
  for (InputScale& scale : policy.input_scales) {
    scale.multiplier = static_cast<std::int32_t>(1U << (random.bits() % 21));
    scale.multiplier -=
        static_cast<std::int32_t>(random.bits() % static_cast<std::uint32_t>(scale.multiplier));
    scale.shift = static_cast<std::uint8_t>(1 + random.bits() % 40);
  }
  draw_layer(random, policy.layer1, static_cast<std::uint8_t>(10 + random.bits() % 8));
  if constexpr (Policy::hidden_layers >= 2) {
    draw_layer(random, policy.layer2, static_cast<std::uint8_t>(10 + random.bits() % 8));
  }
  if constexpr (Policy::hidden_layers >= 3) {
    draw_layer(random, policy.layer3, static_cast<std::uint8_t>(10 + random.bits() % 8));
  }
  draw_layer(random, policy.output, 8);
  return policy;
}

template <std::size_t I, std::size_t H1, std::size_t H2, std::size_t A, class Weight = std::int16_t>
constexpr auto synthetic_policy(std::uint32_t seed) {
  return synthetic_policy_of<Policy<I, H1, H2, A, 1, Weight>>(seed);
}

// A raw input: now small, now great, now at an end of what 32 bits hold.
constexpr std::int32_t draw_raw(SmallRandom& random) {
  using Limits = std::numeric_limits<std::int32_t>;
  switch (random.bits() % 8) {
    case 0:
      return Limits::max();
    case 1:
      return Limits::min();
    case 2:
      return 0;
    default: {
      const std::uint32_t drop = random.bits() % 31;
      return static_cast<std::int32_t>(random.bits()) >> drop;
    }
  }
}

// Shapes that reach every piece of a kernel: whole groups and blocks, what is left of them, and odd counts.
inline constexpr auto synthetic_smallest = synthetic_policy<1, 1, 1, 2>(1);
inline constexpr auto synthetic_odd = synthetic_policy<7, 13, 11, 5>(2);
inline constexpr auto synthetic_rest = synthetic_policy<9, 38, 27, 6>(3);
inline constexpr auto synthetic_half = synthetic_policy<6, 32, 32, 3>(4);
inline constexpr auto synthetic_paper = synthetic_policy<6, 64, 64, 3>(5);
inline constexpr auto synthetic_wide = synthetic_policy<12, 128, 128, 5>(6);

// One hidden layer, and three.
template <std::size_t I, std::size_t H, std::size_t A, class Weight = std::int16_t>
constexpr auto synthetic_shallow(std::uint32_t seed) {
  return synthetic_policy_of<Policy1<I, H, A, 1, Weight>>(seed);
}
template <std::size_t I, std::size_t H1, std::size_t H2, std::size_t H3, std::size_t A,
          class Weight = std::int16_t>
constexpr auto synthetic_deep(std::uint32_t seed) {
  return synthetic_policy_of<Policy3<I, H1, H2, H3, A, 1, Weight>>(seed);
}
inline constexpr auto synthetic_shallow_smallest = synthetic_shallow<1, 1, 2>(12);
inline constexpr auto synthetic_shallow_odd = synthetic_shallow<7, 13, 5>(13);
inline constexpr auto synthetic_shallow_widest = synthetic_shallow<32, 1024, 9>(14);
inline constexpr auto synthetic_deep_smallest = synthetic_deep<1, 1, 1, 1, 2>(15);
inline constexpr auto synthetic_deep_narrow = synthetic_deep<9, 38, 1, 27, 6>(16);
inline constexpr auto synthetic_deep_odd = synthetic_deep<7, 13, 11, 5, 3>(17);
inline constexpr auto synthetic_deep_paper = synthetic_deep<6, 64, 64, 64, 3>(18);
inline constexpr auto synthetic_int8_shallow = synthetic_shallow<7, 13, 5, std::int8_t>(19);
inline constexpr auto synthetic_int8_deep = synthetic_deep<9, 38, 1, 27, 6, std::int8_t>(20);
inline constexpr auto synthetic_int8_deep_paper = synthetic_deep<6, 64, 64, 64, 3, std::int8_t>(21);

inline constexpr auto synthetic_int8_smallest = synthetic_policy<1, 1, 1, 2, std::int8_t>(7);
inline constexpr auto synthetic_int8_odd = synthetic_policy<7, 13, 11, 5, std::int8_t>(8);
inline constexpr auto synthetic_int8_rest = synthetic_policy<9, 38, 27, 6, std::int8_t>(9);
inline constexpr auto synthetic_int8_paper = synthetic_policy<6, 64, 64, 3, std::int8_t>(10);
inline constexpr auto synthetic_int8_wide = synthetic_policy<12, 128, 128, 5, std::int8_t>(11);

}  // namespace striker::policy

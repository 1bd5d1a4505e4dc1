// SPDX-License-Identifier: Apache-2.0
// The proof that a policy carries: computed by the compiler from the header's own numbers. A header that
// could overflow, or that was altered after the export, does not compile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/policy.hpp"

namespace striker::policy {

namespace proof {

inline constexpr std::int64_t sum_limit = (std::int64_t{1} << 31) - 1;
inline constexpr std::int64_t activation_limit = 32767;

// The greatest value |sum| + rounding that one neuron can reach, given the greatest |activation| it reads.
template <std::size_t Inputs, class Weight>
constexpr std::int64_t worst_sum(const std::array<Weight, Inputs>& weights, std::int32_t bias,
                                 std::int64_t rounding, const std::array<std::int64_t, Inputs>& greatest) {
  std::int64_t sum = (bias < 0 ? -std::int64_t{bias} : std::int64_t{bias}) + rounding;
  for (std::size_t i = 0; i < Inputs; ++i) {
    sum += (weights[i] < 0 ? -std::int64_t{weights[i]} : std::int64_t{weights[i]}) * greatest[i];
  }
  return sum;
}

template <std::size_t Outputs>
struct LayerBounds {
  bool fits = true;                                 // every sum stays in 32 bits
  std::array<std::int64_t, Outputs> activations{};  // the greatest that each neuron can store
};

template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr LayerBounds<Outputs> bound_layer(const Layer<Inputs, Outputs, Weight>& layer, bool hidden,
                                           const std::array<std::int64_t, Inputs>& greatest) {
  LayerBounds<Outputs> bounds;
  const std::int64_t rounding = hidden ? std::int64_t{1} << (layer.shift - 1) : 0;
  for (std::size_t j = 0; j < Outputs; ++j) {
    const std::int64_t worst = worst_sum(layer.weights[j], layer.biases[j], rounding, greatest);
    bounds.fits = bounds.fits && worst <= sum_limit;
    bounds.activations[j] = std::min(worst >> layer.shift, activation_limit);
  }
  return bounds;
}

// FNV-1a, 32 bits (Fowler, Noll, Vo), over little-endian bytes. Each step is a bijection of the hash, so one
// altered number always changes the result.
class Fnv1a {
 public:
  template <class Integer>
  constexpr void add(Integer value) {
    for (std::size_t byte = 0; byte < sizeof(Integer); ++byte) {
      const auto octet =
          static_cast<std::uint32_t>((static_cast<std::uint64_t>(value) >> (8 * byte)) & 0xFFU);
      hash_ = (hash_ ^ octet) * 16777619U;
    }
  }
  [[nodiscard]] constexpr std::uint32_t value() const { return hash_; }

 private:
  std::uint32_t hash_ = 2166136261U;
};

template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr void add_layer(Fnv1a& hash, const Layer<Inputs, Outputs, Weight>& layer) {
  for (const auto& row : layer.weights) {
    for (const Weight weight : row) {
      hash.add(weight);
    }
  }
  for (const std::int32_t bias : layer.biases) {
    hash.add(bias);
  }
  hash.add(layer.shift);
}

// From layer n on, whose inputs are `greatest` at most, no sum leaves 32 bits.
template <std::size_t n, class Policy, std::size_t Width>
constexpr bool sums_fit_from(const Policy& policy, const std::array<std::int64_t, Width>& greatest) {
  constexpr bool hidden = n < Policy::hidden_layers;
  const auto bounds = bound_layer(policy.template layer<n>(), hidden, greatest);
  if constexpr (hidden) {
    return bounds.fits && sums_fit_from<n + 1>(policy, bounds.activations);
  } else {
    return bounds.fits;
  }
}

}  // namespace proof

// All shifts and multipliers are in the ranges that policy.hpp states.
template <class W, std::size_t G, std::size_t I, std::size_t A, std::size_t... H>
constexpr bool scales_are_valid(const PolicyOf<W, G, I, A, H...>& policy) {
  const auto hidden_shift = [](std::uint8_t shift) { return shift >= 1 && shift <= 30; };
  bool valid = [&]<std::size_t... n>(std::index_sequence<n...>) {
    return (hidden_shift(policy.template layer<n>().shift) && ...);
  }
  (std::make_index_sequence<sizeof...(H)>{});
  valid = valid && policy.output.shift <= 30 && policy.decision_period_ms > 0;
  for (const InputScale& scale : policy.input_scales) {
    valid = valid && scale.multiplier > 0 && scale.multiplier <= (1 << 20) && scale.shift >= 1 &&
            scale.shift <= 40;
  }
  return valid;
}

// The controller can compute every input.
template <class W, std::size_t G, std::size_t I, std::size_t A, std::size_t... H>
constexpr bool inputs_are_known(const PolicyOf<W, G, I, A, H...>& policy) {
  bool known = I <= greatest_inputs;
  for (const StateInput& input : policy.state) {
    known = known && static_cast<std::size_t>(input.element) < state_elements.size() &&
            input.decisions_ago <= greatest_look_back;
  }
  return known;
}

// No input whatever can drive any neuron's 32-bit sum, rounding included, out of range.
template <class W, std::size_t G, std::size_t I, std::size_t A, std::size_t... H>
constexpr bool sums_fit(const PolicyOf<W, G, I, A, H...>& policy) {
  std::array<std::int64_t, I> input_bounds{};
  input_bounds.fill(proof::activation_limit);
  return proof::sums_fit_from<0>(policy, input_bounds);
}

// The identity of everything that decides an action or proves one. Fields are hashed in the order of their
// declaration, each as the little-endian bytes of its declared type.
template <class W, std::size_t G, std::size_t I, std::size_t A, std::size_t... H>
constexpr std::uint32_t identity_of(const PolicyOf<W, G, I, A, H...>& policy) {
  proof::Fnv1a hash;
  hash.add(policy.configuration_hash);
  hash.add(policy.decision_period_ms);
  for (const StateInput& input : policy.state) {
    hash.add(static_cast<std::uint8_t>(input.element));
    hash.add(input.decisions_ago);
  }
  hash.add(static_cast<std::uint8_t>(policy.mirrored));
  for (const InputScale& scale : policy.input_scales) {
    hash.add(scale.multiplier);
    hash.add(scale.shift);
  }
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (proof::add_layer(hash, policy.template layer<n>()), ...);
  }
  (std::make_index_sequence<sizeof...(H) + 1>{});
  for (const WheelSetPoint& set_point : policy.set_points) {
    hash.add(set_point.left_mm_s);
    hash.add(set_point.right_mm_s);
  }
  for (const auto& golden : policy.golden_vectors) {
    for (const std::int32_t raw : golden.raw) {
      hash.add(raw);
    }
    for (const std::int32_t sum : golden.sums) {
      hash.add(sum);
    }
    hash.add(golden.action);
  }
  return hash.value();
}

}  // namespace striker::policy

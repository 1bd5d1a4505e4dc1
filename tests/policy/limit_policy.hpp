// SPDX-License-Identifier: Apache-2.0
// Networks at the proof's limit: with every raw input at its greatest, every neuron's sum, rounding included, is
// 2^31 - 1, so that one more anywhere would leave 32 bits. Of the output layer every second one is at the other end.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "firmware/policy/policy.hpp"
#include "firmware/policy/proof.hpp"

namespace striker::policy {

template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr void fill_to_limit(Layer<Inputs, Outputs, Weight>& layer, std::uint8_t shift) {
  const std::int64_t rounding = shift > 0 ? std::int64_t{1} << (shift - 1) : 0;
  const std::int64_t reads = std::int64_t{Inputs} * proof::activation_limit;
  const std::int64_t weight =
      std::min<std::int64_t>(std::numeric_limits<Weight>::max(), (proof::sum_limit - rounding) / reads);
  for (auto& row : layer.weights) {
    row.fill(static_cast<Weight>(weight));
  }
  layer.biases.fill(static_cast<std::int32_t>(proof::sum_limit - rounding - weight * reads));
  layer.shift = shift;
}

// A hidden layer's shift by 16 makes 2^15 - 1 of such a sum: what the next layer's limit is counted from.
template <class Policy>
constexpr Policy limit_policy() {
  Policy policy{};
  policy.input_scales.fill({.multiplier = 1 << 20, .shift = 1});
  fill_to_limit(policy.layer1, 16);
  if constexpr (Policy::hidden_layers >= 2) {
    fill_to_limit(policy.layer2, 16);
  }
  if constexpr (Policy::hidden_layers >= 3) {
    fill_to_limit(policy.layer3, 16);
  }
  fill_to_limit(policy.output, 0);
  for (std::size_t k = 1; k < Policy::actions; k += 2) {
    for (auto& weight : policy.output.weights[k]) {
      weight = static_cast<typename Policy::Weight>(-weight);
    }
    policy.output.biases[k] = -policy.output.biases[k];
  }
  policy.decision_period_ms = 50;
  return policy;
}

inline constexpr auto limit_narrow = limit_policy<Policy3<1, 1, 1, 1, 2, 1>>();
inline constexpr auto limit_one = limit_policy<Policy1<6, 13, 3, 1>>();
inline constexpr auto limit_two = limit_policy<Policy<7, 13, 11, 5, 1>>();
inline constexpr auto limit_three = limit_policy<Policy3<6, 40, 1, 27, 3, 1>>();
inline constexpr auto limit_widest = limit_policy<Policy1<32, 1024, 3, 1>>();
inline constexpr auto limit_int8_one = limit_policy<Policy1<6, 13, 3, 1, std::int8_t>>();
inline constexpr auto limit_int8_three = limit_policy<Policy3<6, 40, 1, 27, 3, 1, std::int8_t>>();

}  // namespace striker::policy

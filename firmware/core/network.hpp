// The Q network's kernel: int16 weights and activations, 32-bit sums, ReLU, power-of-two rescaling, argmax.
//
// The arithmetic is the specification in policy.hpp, to the bit. The header's proof makes overflow
// impossible, so no sum is checked here. The instruction count does not depend on the input: saturation, ReLU
// and argmax are masks, never branches (held by tests/timing/kernel_instructions_test).
#pragma once

#include <array>
#include <cstdint>

#include "core/policy.hpp"

namespace striker::core {

namespace kernel {

// All ones if a < b, else 0.
constexpr std::int32_t less_mask(std::int64_t a, std::int64_t b) {
  return static_cast<std::int32_t>((a - b) >> 63);
}

constexpr std::int32_t select(std::int32_t mask, std::int32_t if_set, std::int32_t otherwise) {
  return otherwise ^ ((if_set ^ otherwise) & mask);
}

// min(value, 32767) for value >= 0, and 0 below: ReLU and saturation in one.
constexpr std::int16_t saturate_relu(std::int32_t value) {
  const std::int32_t positive = value & ~(value >> 31);
  return static_cast<std::int16_t>(select(less_mask(32767, positive), 32767, positive));
}

constexpr std::int16_t scale_input(std::int32_t raw, const InputScale& scale) {
  const std::int64_t product = std::int64_t{raw} * scale.multiplier;
  const std::int64_t scaled = (product + (std::int64_t{1} << (scale.shift - 1))) >> scale.shift;
  const std::int64_t above = less_mask(32767, scaled);
  const std::int64_t below = less_mask(scaled, -32767);
  return static_cast<std::int16_t>((scaled & ~(above | below)) | (above & 32767) | (below & -32767));
}

template <std::size_t Inputs>
constexpr std::int32_t dot(const std::array<std::int16_t, Inputs>& weights,
                           const std::array<std::int16_t, Inputs>& activations, std::int32_t bias) {
  std::int32_t sum = bias;
  for (std::size_t i = 0; i < Inputs; ++i) {
    sum += std::int32_t{weights[i]} * activations[i];
  }
  return sum;
}

template <std::size_t Inputs, std::size_t Outputs>
constexpr void hidden_layer(const Layer<Inputs, Outputs>& layer,
                            const std::array<std::int16_t, Inputs>& activations,
                            std::array<std::int16_t, Outputs>& result) {
  const std::int32_t rounding = std::int32_t{1} << (layer.shift - 1);
  for (std::size_t j = 0; j < Outputs; ++j) {
    result[j] =
        saturate_relu((dot(layer.weights[j], activations, layer.biases[j]) + rounding) >> layer.shift);
  }
}

}  // namespace kernel

template <std::size_t Actions>
struct QValues {
  std::array<std::int32_t, Actions> sums{};  // in the output layer's scale: comparable with one another
  std::uint8_t action = 0;                   // of the greatest sum; of equals, the lowest
};

template <std::size_t I, std::size_t H1, std::size_t H2, std::size_t A, std::size_t G>
[[nodiscard]] constexpr QValues<A> infer(const Policy<I, H1, H2, A, G>& policy,
                                         const std::array<std::int32_t, I>& raw) {
  std::array<std::int16_t, I> inputs{};
  for (std::size_t i = 0; i < I; ++i) {
    inputs[i] = kernel::scale_input(raw[i], policy.input_scales[i]);
  }
  std::array<std::int16_t, H1> hidden1{};
  std::array<std::int16_t, H2> hidden2{};
  kernel::hidden_layer(policy.layer1, inputs, hidden1);
  kernel::hidden_layer(policy.layer2, hidden1, hidden2);

  QValues<A> q;
  for (std::size_t k = 0; k < A; ++k) {
    q.sums[k] = kernel::dot(policy.output.weights[k], hidden2, policy.output.biases[k]);
  }
  std::int32_t best = q.sums[0];
  std::int32_t action = 0;
  for (std::size_t k = 1; k < A; ++k) {
    const std::int32_t greater = kernel::less_mask(best, q.sums[k]);
    best = kernel::select(greater, q.sums[k], best);
    action = kernel::select(greater, static_cast<std::int32_t>(k), action);
  }
  q.action = static_cast<std::uint8_t>(action);
  return q;
}

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The kernel in plain C++: the specification as code, for any target and for the compiler itself.
//
// The other kernels are tested against it. Programs take it in builds without optimisation, and
// tools/bench-kernel measures it as "plain". It takes int8 weights too, a byte each.
//
// Example: with weights {3, -2}, activations {100, 50}, bias 4 + 2^3 and shift 4 a neuron's sum is 212, and
// what it stores 13: (204 + 8) >> 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/branch_free.hpp"
#include "firmware/policy/kernel/kernel.hpp"

namespace striker::policy::kernel::int16 {

struct Portable {
  static constexpr const char* name = "int16/portable";
  static constexpr bool rounds = false;

  template <std::size_t Count>
  struct Activations {
    std::array<std::int16_t, Count> values{};
    constexpr void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  template <std::size_t Inputs, std::size_t Outputs, class Weight>
  struct Packed {
    std::array<std::array<Weight, Inputs>, Outputs> weights;
    std::array<std::int32_t, Outputs> biases;
  };

  template <Role, std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr Packed<Inputs, Outputs, Weight> pack(const Layer<Inputs, Outputs, Weight>& layer,
                                                        const std::array<std::int32_t, Outputs>& biases) {
    return {layer.weights, biases};
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr void hidden(const Packed<Inputs, Outputs, Weight>& layer, const Activations<Inputs>& in,
                               Activations<Outputs>& out) {
    for (std::size_t j = 0; j < Outputs; ++j) {
      out.set(j, saturate_relu(dot(layer.weights[j], in.values, layer.biases[j]) >> shift));
    }
  }

  template <std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr void sums(const Packed<Inputs, Outputs, Weight>& layer, const Activations<Inputs>& in,
                             std::array<std::int32_t, Outputs>& out) {
    for (std::size_t k = 0; k < Outputs; ++k) {
      out[k] = dot(layer.weights[k], in.values, layer.biases[k]);
    }
  }

 private:
  template <std::size_t Inputs, class Weight>
  static constexpr std::int32_t dot(const std::array<Weight, Inputs>& weights,
                                    const std::array<std::int16_t, Inputs>& activations, std::int32_t bias) {
    std::int32_t sum = bias;
    for (std::size_t i = 0; i < Inputs; ++i) {
      sum += std::int32_t{weights[i]} * activations[i];
    }
    return sum;
  }
};

}  // namespace striker::policy::kernel::int16

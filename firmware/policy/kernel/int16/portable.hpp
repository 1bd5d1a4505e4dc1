// The kernel in plain C++: the specification as code, for any target and for the compiler itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/scaling.hpp"

namespace striker::policy::kernel {

struct Portable {
  static constexpr const char* name = "portable";

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

  template <std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr Packed<Inputs, Outputs, Weight> pack(const Layer<Inputs, Outputs, Weight>& layer,
                                                        const std::array<std::int32_t, Outputs>& biases) {
    return {layer.weights, biases};
  }

  template <std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr Packed<Inputs, Outputs, Weight> pack_hidden(const Layer<Inputs, Outputs, Weight>& layer) {
    return pack(layer, rounded_biases(layer));
  }
  template <std::size_t Inputs, std::size_t Outputs, class Weight>
  static constexpr Packed<Inputs, Outputs, Weight> pack_output(const Layer<Inputs, Outputs, Weight>& layer) {
    return pack(layer, layer.biases);
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

}  // namespace striker::policy::kernel

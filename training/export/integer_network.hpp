// SPDX-License-Identifier: Apache-2.0
// The exporter's own reference of the integer Q network that firmware/policy/policy.hpp specifies, with sizes
// known only at run time. It shares no code with the firmware, so that the golden vectors it computes check
// one implementation against another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace striker::training {

inline constexpr std::int64_t greatest_activation = 32767;

// A raw state element becomes an activation: (raw * multiplier) / 2^shift, rounded.
struct InputScale {
  std::int32_t multiplier = 1;  // 1 to 2^20
  int shift = 1;                // 1 to 40
};

// What the firmware stores a weight in.
enum class WeightType { int16, int8 };

struct IntegerLayer {
  std::size_t inputs = 0;
  std::vector<std::int16_t> weights;  // row by row: all inputs of neuron 0, of neuron 1, ...
  std::vector<std::int32_t> biases;   // one a neuron
  int shift = 0;                      // hidden: 1 to 30; output: sum >> shift is Q in 1/256

  [[nodiscard]] std::size_t outputs() const { return biases.size(); }
  [[nodiscard]] std::span<const std::int16_t> row(std::size_t neuron) const;
};

// All layers but the last are hidden (ReLU).
struct IntegerNetwork {
  std::vector<InputScale> input_scales;
  std::vector<IntegerLayer> layers;
  WeightType weights = WeightType::int16;
};

[[nodiscard]] constexpr const char* name_of(WeightType type) {
  return type == WeightType::int8 ? "int8" : "int16";
}

struct IntegerAnswer {
  std::vector<std::int32_t> sums;  // the output layer's
  std::size_t action = 0;          // the greatest sum; of equals, the first
};

// What each layer stores for this input: hidden activations, and last the output layer's sums.
// Throws std::overflow_error if a sum leaves 32 bits; that cannot happen once every one of `bound_layers`
// fits.
[[nodiscard]] std::vector<std::vector<std::int32_t>> layer_values(const IntegerNetwork& network,
                                                                  std::span<const std::int32_t> raw);

[[nodiscard]] IntegerAnswer evaluate(const IntegerNetwork& network, std::span<const std::int32_t> raw);

struct LayerBound {
  std::int64_t worst_sum = 0;             // the greatest |sum| + rounding of any neuron, over every input
  std::vector<std::int64_t> activations;  // the greatest that each neuron can store
  [[nodiscard]] bool fits() const { return worst_sum < (std::int64_t{1} << 31); }
};

// The proof obligation, a layer: sum |w| * max |a| + |bias| + rounding < 2^31, with a as it can be stored. An output is
// not rounded; of a network that is not complete yet, `more_follow`, the last layer is none.
[[nodiscard]] std::vector<LayerBound> bound_layers(const IntegerNetwork& network, bool more_follow = false);

}  // namespace striker::training

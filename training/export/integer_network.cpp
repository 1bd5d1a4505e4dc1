// SPDX-License-Identifier: Apache-2.0
#include "training/export/integer_network.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace striker::training {

namespace {

std::int64_t shift_rounded(std::int64_t value, int shift) {
  return (value + (std::int64_t{1} << (shift - 1))) >> shift;
}

std::int32_t scaled_input(std::int32_t raw, const InputScale& scale) {
  const std::int64_t product = std::int64_t{raw} * scale.multiplier;
  return static_cast<std::int32_t>(
      std::clamp(shift_rounded(product, scale.shift), -greatest_activation, greatest_activation));
}

// ReLU and saturation.
std::int32_t stored(std::int32_t sum, int shift) {
  return static_cast<std::int32_t>(
      std::clamp(shift_rounded(sum, shift), std::int64_t{0}, greatest_activation));
}

std::int32_t sum_of(const IntegerLayer& layer, std::size_t neuron,
                    const std::vector<std::int32_t>& activations) {
  std::int64_t sum = layer.biases[neuron];
  const auto weights = layer.row(neuron);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += std::int64_t{weights[i]} * activations[i];
  }
  if (sum < std::numeric_limits<std::int32_t>::min() || sum > std::numeric_limits<std::int32_t>::max()) {
    throw std::overflow_error("a sum of the integer network leaves 32 bits");
  }
  return static_cast<std::int32_t>(sum);
}

LayerBound bound_layer(const IntegerLayer& layer, bool hidden, const std::vector<std::int64_t>& greatest) {
  LayerBound bound;
  const std::int64_t rounding = hidden ? std::int64_t{1} << (layer.shift - 1) : 0;
  for (std::size_t neuron = 0; neuron < layer.outputs(); ++neuron) {
    std::int64_t worst = std::abs(std::int64_t{layer.biases[neuron]}) + rounding;
    const auto weights = layer.row(neuron);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      worst += std::abs(std::int64_t{weights[i]}) * greatest[i];
    }
    bound.worst_sum = std::max(bound.worst_sum, worst);
    bound.activations.push_back(std::min(worst >> layer.shift, greatest_activation));
  }
  return bound;
}

}  // namespace

std::span<const std::int16_t> IntegerLayer::row(std::size_t neuron) const {
  return std::span(weights).subspan(neuron * inputs, inputs);
}

std::vector<std::vector<std::int32_t>> layer_values(const IntegerNetwork& network,
                                                    std::span<const std::int32_t> raw) {
  std::vector<std::int32_t> activations;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    activations.push_back(scaled_input(raw[i], network.input_scales[i]));
  }
  std::vector<std::vector<std::int32_t>> values;
  for (std::size_t l = 0; l < network.layers.size(); ++l) {
    const IntegerLayer& layer = network.layers[l];
    const bool hidden = l + 1 < network.layers.size();
    std::vector<std::int32_t> next;
    for (std::size_t neuron = 0; neuron < layer.outputs(); ++neuron) {
      const std::int32_t sum = sum_of(layer, neuron, activations);
      next.push_back(hidden ? stored(sum, layer.shift) : sum);
    }
    values.push_back(next);
    activations = std::move(next);
  }
  return values;
}

IntegerAnswer evaluate(const IntegerNetwork& network, std::span<const std::int32_t> raw) {
  IntegerAnswer answer{.sums = layer_values(network, raw).back()};
  const auto best = std::max_element(answer.sums.begin(), answer.sums.end());
  answer.action = static_cast<std::size_t>(best - answer.sums.begin());
  return answer;
}

std::vector<LayerBound> bound_layers(const IntegerNetwork& network, bool more_follow) {
  std::vector<LayerBound> bounds;
  std::vector<std::int64_t> greatest(network.input_scales.size(), greatest_activation);
  for (std::size_t l = 0; l < network.layers.size(); ++l) {
    const bool hidden = more_follow || l + 1 < network.layers.size();
    bounds.push_back(bound_layer(network.layers[l], hidden, greatest));
    greatest = bounds.back().activations;
  }
  return bounds;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// The exporter's integer network: its arithmetic and its bounds.
#include "training/export/integer_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace striker::training {
namespace {

constexpr std::int32_t greatest = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();

IntegerLayer layer(std::size_t inputs, std::vector<std::int16_t> weights, std::vector<std::int32_t> biases,
                   int shift) {
  IntegerLayer result;
  result.inputs = inputs;
  result.weights = std::move(weights);
  result.biases = std::move(biases);
  result.shift = shift;
  return result;
}

// One input, one neuron a layer.
IntegerNetwork chain(InputScale scale, int shift) {
  return {.input_scales = {scale}, .layers = {layer(1, {1}, {0}, shift), layer(1, {1}, {0}, 0)}};
}

std::int32_t hidden_of(const IntegerNetwork& network, std::int32_t raw) {
  return layer_values(network, std::vector{raw})[0][0];
}

TEST(IntegerNetwork, RoundsHalvesUpAndCutsAtZero) {
  const IntegerNetwork network = chain({.multiplier = 2, .shift = 1}, 2);
  EXPECT_EQ(hidden_of(network, 5), 1);   // 1.25
  EXPECT_EQ(hidden_of(network, 6), 2);   // 1.5
  EXPECT_EQ(hidden_of(network, -2), 0);  // -0.5 rounds to 0
  EXPECT_EQ(hidden_of(network, -3), 0);  // -0.75 rounds to -1, and ReLU cuts it
}

TEST(IntegerNetwork, InputsAreRoundedAndSaturate) {
  const IntegerNetwork network{.input_scales = {{.multiplier = 3, .shift = 2}},
                               .layers = {layer(1, {1, -1}, {0, 0}, 1), layer(2, {1, 1}, {0}, 0)}};
  const auto stored = [&](std::int32_t raw) { return layer_values(network, std::vector{raw})[0]; };
  EXPECT_EQ(stored(10), (std::vector<std::int32_t>{4, 0}));   // 7.5 -> 8
  EXPECT_EQ(stored(-10), (std::vector<std::int32_t>{0, 4}));  // -7.5 -> -7, half of it 3.5 -> 4
  EXPECT_EQ(stored(greatest), (std::vector<std::int32_t>{16384, 0}));
  EXPECT_EQ(stored(least), (std::vector<std::int32_t>{0, 16384}));
}

TEST(IntegerNetwork, HiddenActivationsSaturate) {
  const IntegerNetwork network{.input_scales = {{.multiplier = 2, .shift = 1}},
                               .layers = {layer(1, {1000}, {0}, 4), layer(1, {1}, {0}, 0)}};
  EXPECT_EQ(hidden_of(network, 500), 31250);
  EXPECT_EQ(hidden_of(network, 600), 32767);
  EXPECT_EQ(hidden_of(network, greatest), 32767);
}

TEST(IntegerNetwork, OfEqualSumsTheFirstIsChosen) {
  const IntegerNetwork network{.input_scales = {{.multiplier = 2, .shift = 1}},
                               .layers = {layer(1, {1, 2, 2}, {0, 0, 0}, 0)}};
  EXPECT_EQ(evaluate(network, std::vector{5}).action, 1U);
  EXPECT_EQ(evaluate(network, std::vector{0}).action, 0U);
}

IntegerNetwork random_network(std::mt19937& random) {
  const auto some_layer = [&random](std::size_t inputs, std::size_t outputs, int limit, int shift) {
    std::uniform_int_distribution<int> weight(-limit, limit);
    std::uniform_int_distribution<std::int32_t> bias(-1'000'000, 1'000'000);
    IntegerLayer result = layer(inputs, {}, {}, shift);
    for (std::size_t i = 0; i < inputs * outputs; ++i) {
      result.weights.push_back(static_cast<std::int16_t>(weight(random)));
    }
    for (std::size_t i = 0; i < outputs; ++i) {
      result.biases.push_back(bias(random));
    }
    return result;
  };
  return {.input_scales = std::vector<InputScale>(6, {.multiplier = 100, .shift = 10}),
          .layers = {some_layer(6, 16, 9000, 12), some_layer(16, 16, 3000, 12), some_layer(16, 3, 3000, 5)}};
}

TEST(IntegerNetwork, NoInputLeavesTheBounds) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> raw(least, greatest);
  std::uniform_int_distribution<int> coin(0, 1);
  for (int n = 0; n < 30; ++n) {
    const IntegerNetwork network = random_network(random);
    const auto bounds = bound_layers(network);
    for (const LayerBound& bound : bounds) {
      ASSERT_TRUE(bound.fits());
    }
    for (int i = 0; i < 100; ++i) {
      std::vector<std::int32_t> input(6);
      for (std::int32_t& element : input) {
        element = i % 2 == 0 ? raw(random) : coin(random) == 1 ? greatest : least;
      }
      const auto values = layer_values(network, input);
      for (std::size_t l = 0; l < values.size(); ++l) {
        for (std::size_t j = 0; j < values[l].size(); ++j) {
          const bool hidden = l + 1 < values.size();
          ASSERT_LE(std::abs(std::int64_t{values[l][j]}),
                    hidden ? bounds[l].activations[j] : bounds[l].worst_sum);
        }
      }
    }
  }
}

// The bound of a layer that reads the inputs is not only safe but reached: by the input with the weights'
// signs.
TEST(IntegerNetwork, TheFirstBoundIsReached) {
  const std::vector<std::int16_t> weights = {300, -20000, 7, -1, 12345, -500};
  const IntegerNetwork network{.input_scales = std::vector<InputScale>(6, {.multiplier = 2, .shift = 1}),
                               .layers = {layer(6, weights, {4711}, 0)}};
  std::vector<std::int32_t> input;
  input.reserve(weights.size());
  for (const std::int16_t weight : weights) {
    input.push_back(weight > 0 ? greatest : least);
  }
  EXPECT_EQ(evaluate(network, input).sums[0], bound_layers(network)[0].worst_sum);
}

TEST(IntegerNetwork, ASumBeyond32BitsIsFoundByProofAndPlay) {
  const IntegerNetwork network{.input_scales = std::vector<InputScale>(3, {.multiplier = 2, .shift = 1}),
                               .layers = {layer(3, {32767, 32767, 5}, {0}, 0)}};
  EXPECT_FALSE(bound_layers(network)[0].fits());
  EXPECT_THROW((void)evaluate(network, std::vector{greatest, greatest, greatest}), std::overflow_error);
}

}  // namespace
}  // namespace striker::training

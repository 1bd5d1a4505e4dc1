// SPDX-License-Identifier: Apache-2.0
// What the packing of layers is made of: a layer's rows become the words that a kernel reads from front to
// back, each used once. All of it is run by the compiler; only the words reach the image.
//
// The kernels' words: two, four or more rows are a group, whose sums are built side by side, so that each
// activation, once loaded, serves all of them. A group's words are its biases, and then, for one block of
// columns after another, its rows' weights. For two rows of three columns, with a half-word a weight:
//
//   bias 0, bias 1, (w01 w00), (0 w02), (w11 w10), (0 w12)        (upper lower) half-word of a word
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/policy.hpp"

namespace striker::policy::kernel {

constexpr std::size_t round_up(std::size_t count, std::size_t multiple) {
  return (count + multiple - 1) / multiple * multiple;
}

// Two half-words, side by side in a word.
constexpr std::uint32_t half_words(std::int32_t high, std::int32_t low) {
  return (static_cast<std::uint32_t>(high) << 16U) | (static_cast<std::uint32_t>(low) & 0xFFFFU);
}

// A layer's weight, or 0 beyond its rows and columns.
template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr std::int32_t weight_or_zero(const Layer<Inputs, Outputs, Weight>& layer, std::size_t row,
                                      std::size_t column) {
  return row < Outputs && column < Inputs ? layer.weights[row][column] : 0;
}

// Fills an array of words from its front.
template <class Words>
struct WordWriter {
  Words words{};
  std::size_t count = 0;

  constexpr void add(std::uint32_t word) { words[count++] = word; }
  constexpr void add(std::int32_t word) { add(static_cast<std::uint32_t>(word)); }
};

// A hidden layer's biases with the rounding in them that comes before its shift: one addition fewer a neuron.
// The proof bounds bias and rounding together.
template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr std::array<std::int32_t, Outputs> rounded_biases(const Layer<Inputs, Outputs, Weight>& layer) {
  auto biases = layer.biases;
  for (std::int32_t& bias : biases) {
    bias += std::int32_t{1} << (layer.shift - 1);
  }
  return biases;
}

}  // namespace striker::policy::kernel

// Weights as the Arm kernels read them: one stream of words, from front to back, with every word used once.
//
// A group is the rows whose sums are built side by side, so that each activation, once loaded, serves all of
// them. A group's words: its biases, then for one block of columns after another its rows' weights.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/policy.hpp"

namespace striker::policy::kernel {

// One half-word beside the other.
constexpr std::uint32_t half_words(std::int32_t high, std::int32_t low) {
  return (static_cast<std::uint32_t>(high) << 16U) | (static_cast<std::uint32_t>(low) & 0xFFFFU);
}

// A layer's weight, or 0 beyond its rows and columns.
template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr std::int32_t weight_or_zero(const Layer<Inputs, Outputs, Weight>& layer, std::size_t row,
                                      std::size_t column) {
  return row < Outputs && column < Inputs ? layer.weights[row][column] : 0;
}

template <class Words>
struct WordWriter {
  Words words{};
  std::size_t count = 0;

  constexpr void add(std::uint32_t word) { words[count++] = word; }
  constexpr void add(std::int32_t word) { add(static_cast<std::uint32_t>(word)); }
};

// Activations in words of their own, or two in a word.
template <std::size_t Words>
struct alignas(8) WordBuffer {
  std::array<std::uint32_t, Words> words;
};

// What was stored is in memory by now, for assembly or for loads of another width to read.
template <class Buffer>
[[gnu::always_inline]] inline void finish_stores(const Buffer& buffer) {
  asm volatile("" : : "r"(&buffer) : "memory");
}

constexpr std::size_t round_up(std::size_t count, std::size_t multiple) {
  return (count + multiple - 1) / multiple * multiple;
}

}  // namespace striker::policy::kernel

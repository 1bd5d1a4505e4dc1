// SPDX-License-Identifier: Apache-2.0
// What the int8 kernels without packed words share (Helium, and plain C++): a byte a weight, and rows in
// groups of four, whose sums are built side by side.
//
// A kernel packs the weights in the order in which it takes them within a group, and gives
//
//   add_products(sums, weights, in)   which adds the products of a group's rows (4, or the 1 to 3 of the last
//                                     group) to their sums; `weights` are the group's first
//
// Example: a layer of 6 rows has a group of 4, whose weights begin at 0, and one of 2, at 4 * Inputs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int8 {

inline constexpr std::size_t group_rows = 4;

template <std::size_t Inputs, std::size_t Outputs>
struct RowGroups {
  static constexpr std::size_t inputs = Inputs;
  static constexpr std::size_t outputs = Outputs;
  // Whole words, without padding: they are hashed at run time.
  std::array<std::int8_t, round_up(Inputs* Outputs, 4)> weights{};
  std::array<std::int32_t, Outputs> biases{};
};

// Hands over the sums of the group that begins with the row `first`: take(row, sum).
template <class Kernel, std::size_t Rows, class Packed, class Activations, class Take>
[[gnu::always_inline]] inline void group_sums(const Packed& layer, std::size_t first, const Activations& in,
                                              Take take) {
  std::array<std::int32_t, Rows> sums{};
#pragma GCC unroll 4
  for (std::size_t r = 0; r < Rows; ++r) {
    sums[r] = layer.biases[first + r];
  }
  Kernel::add_products(sums, &layer.weights[first * Packed::inputs], in);
#pragma GCC unroll 4
  for (std::size_t r = 0; r < Rows; ++r) {
    take(first + r, sums[r]);
  }
}

// Hands over the sums of all of a layer's rows, in their order: take(row, sum).
template <class Kernel, class Packed, class Activations, class Take>
[[gnu::always_inline]] inline void each_sum(const Packed& layer, const Activations& in, Take take) {
  constexpr std::size_t rest = Packed::outputs % group_rows;
  for (std::size_t first = 0; first + group_rows <= Packed::outputs; first += group_rows) {
    group_sums<Kernel, group_rows>(layer, first, in, take);
  }
  if constexpr (rest != 0) {
    group_sums<Kernel, rest>(layer, Packed::outputs - rest, in, take);
  }
}

}  // namespace striker::policy::kernel::int8

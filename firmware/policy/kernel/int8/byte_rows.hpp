// What the int8 kernels of the Cortex-M55, M3, M0+ and the host share: a byte a weight, four rows at a time.
//
// A kernel says in which order the weights lie, and how a group's products are added:
//
//   add_products(sums, weights, in)   to a group's sums; `weights` are the group's first
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace striker::policy::kernel {

inline constexpr std::size_t byte_group_rows = 4;

template <std::size_t Inputs, std::size_t Outputs>
struct ByteRows {
  static constexpr std::size_t inputs = Inputs;
  static constexpr std::size_t outputs = Outputs;
  std::array<std::int8_t, Inputs * Outputs> weights{};
  std::array<std::int32_t, Outputs> biases{};
};

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

// Hands over the sums of a layer's rows.
template <class Kernel, class Packed, class Activations, class Take>
[[gnu::always_inline]] inline void each_sum(const Packed& layer, const Activations& in, Take take) {
  constexpr std::size_t rest = Packed::outputs % byte_group_rows;
  for (std::size_t first = 0; first + byte_group_rows <= Packed::outputs; first += byte_group_rows) {
    group_sums<Kernel, byte_group_rows>(layer, first, in, take);
  }
  if constexpr (rest != 0) {
    group_sums<Kernel, rest>(layer, Packed::outputs - rest, in, take);
  }
}

}  // namespace striker::policy::kernel

// The kernel for int8 weights without vectors or the DSP extension: Cortex-M3, M0+ and the host.
//
// Plain loops, each byte loaded with its sign. Four rows share the activations; their weights lie column by
// column, so that one pointer finds them all.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/int8/byte_rows.hpp"
#include "firmware/policy/kernel/scaling.hpp"

namespace striker::policy::kernel {

struct Bytes {
  static constexpr const char* name = "bytes";

  template <std::size_t Count>
  struct Activations {
    std::array<std::int16_t, Count> values;
    void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = ByteRows<Inputs, Outputs>;

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs, std::int8_t>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    Packed<Inputs, Outputs> packed{{}, biases};
    std::size_t at = 0;
    for (std::size_t first = 0; first < Outputs; first += byte_group_rows) {
      for (std::size_t column = 0; column < Inputs; ++column) {
        for (std::size_t row = first; row < std::min(first + byte_group_rows, Outputs); ++row) {
          packed.weights[at++] = layer.weights[row][column];
        }
      }
    }
    return packed;
  }

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_hidden(const Layer<Inputs, Outputs, std::int8_t>& layer) {
    return pack(layer, rounded_biases(layer));
  }
  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_output(const Layer<Inputs, Outputs, std::int8_t>& layer) {
    return pack(layer, layer.biases);
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    each_sum<Bytes>(layer, in,
                    [&out](std::size_t row, std::int32_t sum) { out.set(row, saturate_relu(sum >> shift)); });
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    each_sum<Bytes>(layer, in, [&out](std::size_t row, std::int32_t sum) { out[row] = sum; });
  }

  template <std::size_t Rows, std::size_t Inputs>
  [[gnu::always_inline]] static void add_products(std::array<std::int32_t, Rows>& sums,
                                                  const std::int8_t* weights, const Activations<Inputs>& in) {
    for (const std::int16_t shared : in.values) {
#pragma GCC unroll 4
      for (std::size_t r = 0; r < Rows; ++r) {
        sums[r] += weights[r] * shared;
      }
      weights += Rows;
    }
  }
};

}  // namespace striker::policy::kernel

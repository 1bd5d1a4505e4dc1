// SPDX-License-Identifier: Apache-2.0
// The kernel for int8 weights in plain C++: Cortex-M3, M0+, the host, and builds without optimisation.
//
// Neither Armv6-M nor Armv7-M widens several bytes at once: each byte is loaded with its sign. Four rows
// share an activation. Their weights lie column by column, so that one pointer finds them all:
//
//   w00 w10 w20 w30, w01 w11 w21 w31, ...                    wRC: row R's weight of column C
//
// Of a column of four rows GCC makes 12 instructions on the Cortex-M3, 3 for each product:
//
//   ldrsh r1, [r0], #2                                       the activation
//   ldrsb fp, [r3, #-4]    mla r7, r1, fp, r7                row 0; and so for rows 1 to 3
//   add   r3, r3, #4       cmp r0, ip     bne                on to the next column
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/branch_free.hpp"
#include "firmware/policy/kernel/int8/row_groups.hpp"
#include "firmware/policy/kernel/kernel.hpp"

namespace striker::policy::kernel::int8 {

struct Plain {
  static constexpr const char* name = "int8/plain";
  static constexpr bool rounds = false;

  template <std::size_t Count>
  struct Activations {
    std::array<std::int16_t, Count> values;
    void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = RowGroups<Inputs, Outputs>;

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs, std::int8_t>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    Packed<Inputs, Outputs> packed{{}, biases};
    std::size_t at = 0;
    for (std::size_t first = 0; first < Outputs; first += group_rows) {
      for (std::size_t column = 0; column < Inputs; ++column) {
        for (std::size_t row = first; row < std::min(first + group_rows, Outputs); ++row) {
          packed.weights[at++] = layer.weights[row][column];
        }
      }
    }
    return packed;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    each_sum<Plain>(layer, in,
                    [&out](std::size_t row, std::int32_t sum) { out.set(row, saturate_relu(sum >> shift)); });
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    each_sum<Plain>(layer, in, [&out](std::size_t row, std::int32_t sum) { out[row] = sum; });
  }

  // A group's weights lie column by column.
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

}  // namespace striker::policy::kernel::int8

// SPDX-License-Identifier: Apache-2.0
// The kernel for int8 weights and the M-profile Vector Extension (Helium): Cortex-M55.
//
// VLDRB.S16 widens eight bytes to half-words as it loads them, for VMLADAVA, which multiplies eight pairs and
// adds all products to a general register. The rows lie one after the other, a byte a weight, nothing between
// them; four rows share the activations. The sums are rescaled as in int16/helium.hpp.
//
// Of four rows and eight columns GCC makes 9 instructions for 32 products, beside the loop's own:
//
//   vldrh.16     q2, [lr]                            the activations
//   vldrb.s16    q0, [r2, #39]                       row 3's weights of them; 39 is 3 rows of 13 bytes
//   vmladava.s16 r4, q0, q2                          and so for the other rows
#pragma once

#include <arm_mve.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/int16/helium.hpp"
#include "firmware/policy/kernel/int8/row_groups.hpp"
#include "firmware/policy/kernel/kernel.hpp"

namespace striker::policy::kernel::int8 {

struct Helium {
  static constexpr const char* name = "int8/helium";
  static constexpr bool rounds = true;  // by VQRSHRN, in store_all()

  static constexpr std::size_t lanes = int16::helium::lanes;

  template <std::size_t Count>
  using Activations = int16::Helium::Activations<Count>;

  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = RowGroups<Inputs, Outputs>;

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs, std::int8_t>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    Packed<Inputs, Outputs> packed{{}, biases};
    auto to = packed.weights.begin();
    for (const auto& row : layer.weights) {
      to = std::copy(row.begin(), row.end(), to);
    }
    return packed;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    alignas(16) std::array<std::int32_t, int16::Helium::columns(Outputs)> all;
    finish_stores(in);
    each_sum<Helium>(layer, in, [&all](std::size_t row, std::int32_t sum) { all[row] = sum; });
    int16::helium::store_all<shift, int16::Helium::columns(Outputs)>(all.data(), out.values.data());
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    finish_stores(in);
    each_sum<Helium>(layer, in, [&out](std::size_t row, std::int32_t sum) { out[row] = sum; });
  }

  // A group's weights lie row by row. A row's last vector may be short: a predicated load fills it with
  // zeros, so that it does not matter what the activations are there.
  template <std::size_t Rows, std::size_t Inputs>
  [[gnu::always_inline]] static void add_products(std::array<std::int32_t, Rows>& sums,
                                                  const std::int8_t* weights, const Activations<Inputs>& in) {
    constexpr std::size_t whole = Inputs / lanes * lanes;
    for (std::size_t i = 0; i < whole; i += lanes) {
      const int16x8_t shared = vld1q_s16(&in.values[i]);
#pragma GCC unroll 4
      for (std::size_t r = 0; r < Rows; ++r) {
        sums[r] = vmladavaq_s16(sums[r], vldrbq_s16(weights + r * Inputs + i), shared);
      }
    }
    if constexpr (whole != Inputs) {
      const int16x8_t shared = vld1q_s16(&in.values[whole]);
      const mve_pred16_t present = vctp16q(Inputs - whole);
#pragma GCC unroll 4
      for (std::size_t r = 0; r < Rows; ++r) {
        sums[r] = vmladavaq_s16(sums[r], vldrbq_z_s16(weights + r * Inputs + whole, present), shared);
      }
    }
  }
};

}  // namespace striker::policy::kernel::int8

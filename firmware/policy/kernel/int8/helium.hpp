// The kernel for int8 weights and the M-profile Vector Extension (Helium): Cortex-M55.
//
// VLDRB.S16 widens eight bytes as it loads them, for VMLADAVA; four rows share the activations.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/int16/helium.hpp"
#include "firmware/policy/kernel/int8/byte_rows.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel {

struct MveBytes {
  static constexpr const char* name = "bytes, mve";

  // The rows as they are, one after the other.
  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = ByteRows<Inputs, Outputs>;

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_output(const Layer<Inputs, Outputs, std::int8_t>& layer) {
    Packed<Inputs, Outputs> packed{{}, layer.biases};
    auto to = packed.weights.begin();
    for (const auto& row : layer.weights) {
      to = std::copy(row.begin(), row.end(), to);
    }
    return packed;
  }

  template <std::size_t Count>
  using Activations = Mve::Activations<Count>;

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_hidden(const Layer<Inputs, Outputs, std::int8_t>& layer) {
    return pack_output(layer);  // store_all() rounds
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    alignas(16) std::array<std::int32_t, Mve::columns(Outputs)> all;
    finish_stores(in);
    each_sum<MveBytes>(layer, in, [&all](std::size_t row, std::int32_t sum) { all[row] = sum; });
    mve::store_all<shift, Mve::columns(Outputs)>(all.data(), out.values.data());
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    finish_stores(in);
    each_sum<MveBytes>(layer, in, [&out](std::size_t row, std::int32_t sum) { out[row] = sum; });
  }

  // A row's last vector may be short: past it the weights are 0, whatever the activations.
  template <std::size_t Rows, std::size_t Inputs>
  [[gnu::always_inline]] static void add_products(std::array<std::int32_t, Rows>& sums,
                                                  const std::int8_t* weights, const Activations<Inputs>& in) {
    constexpr std::size_t whole = Inputs / mve::lanes * mve::lanes;
    for (std::size_t i = 0; i < whole; i += mve::lanes) {
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

}  // namespace striker::policy::kernel

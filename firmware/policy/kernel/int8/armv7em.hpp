// SPDX-License-Identifier: Apache-2.0
// The kernel for int8 weights and cores with the DSP extension: Cortex-M4, M7, M33 and R5.
//
// A word holds two rows' weights of two columns, the rows' bytes in turns:
//
//   (w11 w01 w10 w00)                                wRC: row R's weight of column C; the low byte last
//
// SXTB16 makes a pair of half-words of its even bytes, which are the one row's, and with ROR #8 of the odd
// ones, for SMLAD. Rows go in groups of four, so that a pair of activations serves four SMLAD. For four rows
// and a pair of columns, 8 products, GCC makes of multiply_rows() 9 instructions:
//
//   ldrd   r8, ip, [r3], #8                          two words: rows 0 and 1, rows 2 and 3
//   sxtb16 r9, r8                smlad r1, r9, lr, r1      row 0
//   sxtb16 r8, r8, ror #8        smlad r4, r8, lr, r4      row 1; and so, from ip, for rows 2 and 3
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/int16/armv7em.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int8 {

struct Armv7em {
  static constexpr const char* name = "int8/armv7em";
  static constexpr bool rounds = false;

  static constexpr std::size_t pairs(std::size_t count) { return (count + 1) / 2; }

  template <std::size_t Count>
  using Activations = int16::Armv7em::Activations<Count>;

  // Groups of four rows, and one of two for what is left. A group's words: its biases, then for each pair of
  // columns a word for each pair of rows.
  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = std::array<std::uint32_t, pairs(Outputs) * (2 + pairs(Inputs))>;

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs, std::int8_t>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    WordWriter<Packed<Inputs, Outputs>> packed;
    for (std::size_t first = 0; first < Outputs; first += 4) {
      const std::size_t end = std::min(first + 4, 2 * pairs(Outputs));
      for (std::size_t row = first; row < end; ++row) {
        packed.add(row < Outputs ? biases[row] : 0);
      }
      for (std::size_t column = 0; column < Inputs; column += 2) {
        for (std::size_t row = first; row < end; row += 2) {
          const auto byte = [&](std::size_t r, std::size_t c) {
            return static_cast<std::uint32_t>(weight_or_zero(layer, row + r, column + c)) & 0xFFU;
          };
          packed.add(byte(0, 0) | byte(1, 0) << 8U | byte(0, 1) << 16U | byte(1, 1) << 24U);
        }
      }
    }
    return packed.words;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    std::uint32_t* to = out.words.data();
    each_pair<Inputs, Outputs>(layer.data(), in, [&](Two sums) {
      *to++ = int16::armv7em::stored<shift>(sums.first) | int16::armv7em::stored<shift>(sums.second) << 16U;
    });
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    std::array<std::int32_t, 2 * pairs(Outputs)> all;
    std::int32_t* to = all.data();
    each_pair<Inputs, Outputs>(layer.data(), in, [&](Two sums) {
      *to++ = sums.first;
      *to++ = sums.second;
    });
    std::copy_n(all.begin(), Outputs, out.begin());
  }

 private:
  using Two = int16::armv7em::Two;

  // The sums of a group's first and second pair of rows.
  struct Sums {
    Two upper, lower;
  };

  // Adds the products of a pair of rows and a pair of columns: one word of weights.
  [[gnu::always_inline]] static Two multiply(Two sums, std::int32_t weights, std::int32_t shared) {
    std::int32_t row;
    asm("sxtb16 %0, %1" : "=r"(row) : "r"(weights));
    asm("smlad %0, %1, %2, %0" : "+r"(sums.first) : "r"(row), "r"(shared));
    asm("sxtb16 %0, %1, ror #8" : "=r"(row) : "r"(weights));
    asm("smlad %0, %1, %2, %0" : "+r"(sums.second) : "r"(row), "r"(shared));
    return sums;
  }

  // Adds the products of a group's rows (one pair of them or two) and a pair of columns.
  template <std::size_t RowPairs>
  [[gnu::always_inline]] static Sums multiply_rows(Sums sums, const std::uint32_t*& weights,
                                                   std::int32_t shared) {
    if constexpr (RowPairs == 2) {
      const auto [upper, lower] = int16::armv7em::load_two(weights);
      return {multiply(sums.upper, upper, shared), multiply(sums.lower, lower, shared)};
    } else {
      return {multiply(sums.upper, static_cast<std::int32_t>(*weights++), shared), {}};
    }
  }

  // Adds the products of a group's rows and `Blocks` times two pairs of columns.
  template <std::size_t RowPairs, std::size_t Blocks>
  [[gnu::always_inline]] static Sums multiply_blocks(Sums sums, const std::uint32_t*& weights,
                                                     const std::uint32_t*& activations) {
#pragma GCC unroll 4
    for (std::size_t block = 0; block < Blocks; ++block) {
      const auto [first, second] = int16::armv7em::load_two(activations);
      sums = multiply_rows<RowPairs>(sums, weights, first);
      sums = multiply_rows<RowPairs>(sums, weights, second);
    }
    return sums;
  }

  // The sums of a whole group; `weights` is left at the next one.
  template <std::size_t RowPairs, std::size_t Pairs>
  [[gnu::always_inline]] static Sums group_sums(const std::uint32_t*& weights,
                                                const std::uint32_t* activations) {
    constexpr std::size_t blocks = Pairs / 2;
    Sums sums{int16::armv7em::load_two(weights), {}};
    if constexpr (RowPairs == 2) {
      sums.lower = int16::armv7em::load_two(weights);
    }
    for (std::size_t turn = 0; turn < blocks / 4; ++turn) {
      sums = multiply_blocks<RowPairs, 4>(sums, weights, activations);
    }
    sums = multiply_blocks<RowPairs, blocks % 4>(sums, weights, activations);
    if constexpr (Pairs % 2 != 0) {
      sums = multiply_rows<RowPairs>(sums, weights, static_cast<std::int32_t>(*activations));
    }
    return sums;
  }

  // Hands over the sums of a layer's rows, two by two; an odd last one comes with a row of zeros.
  template <std::size_t Inputs, std::size_t Outputs, class Take>
  [[gnu::always_inline]] static void each_pair(const std::uint32_t* weights, const Activations<Inputs>& in,
                                               Take take) {
    finish_stores(in);
    for (std::size_t group = 0; group < pairs(Outputs) / 2; ++group) {
      const Sums sums = group_sums<2, pairs(Inputs)>(weights, in.words.data());
      take(sums.upper);
      take(sums.lower);
    }
    if constexpr (pairs(Outputs) % 2 != 0) {
      take(group_sums<1, pairs(Inputs)>(weights, in.words.data()).upper);
    }
  }
};

}  // namespace striker::policy::kernel::int8

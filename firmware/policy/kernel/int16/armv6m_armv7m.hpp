// SPDX-License-Identifier: Apache-2.0
// The kernel for int16 weights and cores without the DSP extension: Armv7-M (Cortex-M3) and Armv6-M
// (Cortex-M0+). Two rows share a word.
//
// A word holds W = top * 2^16 + bottom, top a weight of the upper row, and bottom (0 to 65535) the lower
// row's weight plus 2^15. With T = sum of top * a and S = sum of W * a, all modulo 2^32,
//
//   upper row = T          lower row = S - T * 2^16 - 2^15 * sum of a
//
// so that one shift unpacks two weights, where a sign extension each would take two: 5 instructions for two
// products on Armv6-M, 3 on Armv7-M. The results are exact, as the proof shows that each row's sum fits 32
// bits. The sum of the activations is one number a layer. Activations take a word each.
//
// Example: with weights 3 (upper) and -2 (lower) a word is 0x00037FFE. For a = 100 T is 300, S is
// 300 * 2^16 + 32766 * 100, and the lower row S - 300 * 2^16 - 2^15 * 100 = -200.
//
// A layer's words are groups of rows (6 on Armv6-M or 4, then 4, 2 and 1 for what is left): what each pair's
// S and T begin with, then, for one turn of columns after another, a word a column of each pair of rows. What
// the assembler makes of them is shown in armv6m_armv7m_block.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/branch_free.hpp"
#include "firmware/policy/kernel/int16/armv6m_armv7m_block.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int16 {

namespace armv6m_armv7m {

// The sums of a group's rows, in their order; `weights` is left at the next group. `offset` is 2^15 times
// the sum of the activations.
template <std::size_t Rows, std::size_t Columns>
[[gnu::always_inline]] inline std::array<std::int32_t, Rows> group_sums(const std::uint32_t*& weights,
                                                                        const std::uint32_t* activations,
                                                                        std::uint32_t offset) {
  Sums sums = load_sums<Rows>(weights);
#pragma GCC unroll 16
  for (std::size_t block = 0; block < Columns / block_columns; ++block) {
    multiply_block<Rows, block_columns>(weights, activations, sums);
  }
  if constexpr (Columns % block_columns != 0) {
    multiply_block<Rows, Columns % block_columns>(weights, activations, sums);
  }
  const auto upper = [](std::uint32_t top) { return static_cast<std::int32_t>(top); };
  const auto lower = [offset](std::uint32_t both, std::uint32_t top) {
    return static_cast<std::int32_t>(both - (top << 16U) - offset);
  };
  if constexpr (Rows == 1) {
    return {upper(sums.both0)};
  } else if constexpr (Rows == 2) {
    return {lower(sums.both0, sums.top0), upper(sums.top0)};
  } else if constexpr (Rows == 4) {
    return {lower(sums.both0, sums.top0), upper(sums.top0), lower(sums.both1, sums.top1), upper(sums.top1)};
  } else {
    return {lower(sums.both0, sums.top0), upper(sums.top0), lower(sums.both1, sums.top1), upper(sums.top1),
            lower(sums.both2, sums.top2), upper(sums.top2)};
  }
}

// The rows that the next group takes, of those that are left: the greatest group, or 4, 2, 1.
constexpr std::size_t next_group(std::size_t rows_left) {
  return rows_left >= greatest_group ? greatest_group : rows_left >= 4 ? 4 : rows_left >= 2 ? 2 : 1;
}

// Hands the sums of a layer's rows to `take`, one after the other.
template <std::size_t Rows, std::size_t Columns, class Take>
[[gnu::always_inline]] inline void each_sum(const std::uint32_t* weights, const std::uint32_t* activations,
                                            std::uint32_t offset, Take take) {
  constexpr std::size_t group = next_group(Rows);
  constexpr std::size_t all_groups = Rows / group;
  const auto take_group = [&]() __attribute__((always_inline)) {
    const auto sums = group_sums<group, Columns>(weights, activations, offset);
    [&]<std::size_t... r>(std::index_sequence<r...>) {
      (take(sums[r]), ...);
    }
    (std::make_index_sequence<group>{});
  };
  // Where groups are small the loop's own instructions count: there a turn takes several groups.
  constexpr std::size_t groups = Columns <= 16 ? 4 : 1;
  for (std::size_t turn = 0; turn < all_groups / groups; ++turn) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < groups; ++i) {
      take_group();
    }
  }
  for (std::size_t i = 0; i < all_groups % groups; ++i) {
    take_group();
  }
  if constexpr (Rows % group != 0) {
    each_sum<Rows % group, Columns>(weights, activations, offset, take);
  }
}

// A sum as it is stored: rescaled, not below 0, not above 32767.
template <int shift>
[[gnu::always_inline]] inline std::uint32_t stored(std::int32_t sum) {
#ifdef __ARM_FEATURE_SAT
  std::uint32_t value;
  asm("usat %0, #15, %1, asr %2" : "=r"(value) : "r"(sum), "i"(shift));
  return value;
#else
  return static_cast<std::uint32_t>(saturate_relu(sum >> shift));
#endif
}

}  // namespace armv6m_armv7m

struct Armv6mArmv7m {
  static constexpr const char* name = __ARM_ARCH >= 7 ? "int16/armv7m" : "int16/armv6m";
  static constexpr bool rounds = false;

  static constexpr std::size_t columns(std::size_t inputs) { return round_up(inputs, 2); }

  // A word each, and 2^15 times their sum. An odd count is filled up with a zero.
  template <std::size_t Count>
  struct Activations : WordBuffer<columns(Count)> {
    std::uint32_t offset = 0;
    Activations() {
      if constexpr (Count % 2 != 0) {
        this->words[Count] = 0;
      }
    }
    void set(std::size_t i, std::int32_t value) {
      this->words[i] = static_cast<std::uint32_t>(value);
      offset += static_cast<std::uint32_t>(value) << 15U;
    }
  };

  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = std::array<std::uint32_t, Outputs + (Outputs + 1) / 2 * columns(Inputs)>;

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    WordWriter<Packed<Inputs, Outputs>> packed;
    std::size_t group = 0;
    for (std::size_t first = 0; first < Outputs; first += group) {
      group = armv6m_armv7m::next_group(Outputs - first);
      const std::size_t step = group == 1 ? 1 : 2;
      for (std::size_t row = first; row < first + group; row += step) {
        const auto lower = static_cast<std::uint32_t>(biases[row]);
        const std::uint32_t upper = group == 1 ? 0 : static_cast<std::uint32_t>(biases[row + 1]);
        packed.add(lower + (upper << 16U));
        if (group > 1) {
          packed.add(upper);
        }
      }
      for (std::size_t block = 0; block < columns(Inputs); block += armv6m_armv7m::turn_columns) {
        for (std::size_t row = first; row < first + group; row += step) {
          for (std::size_t i = block; i < std::min(block + armv6m_armv7m::turn_columns, columns(Inputs));
               ++i) {
            const std::int32_t lower = weight_or_zero(layer, row, i);
            packed.add(group == 1 ? static_cast<std::uint32_t>(lower)
                                  : half_words(weight_or_zero(layer, row + 1, i), lower + (1 << 15)));
          }
        }
      }
    }
    return packed.words;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    finish_stores(in);
    std::uint32_t* to = out.words.data();
    std::uint32_t total = 0;
    armv6m_armv7m::each_sum<Outputs, columns(Inputs)>(
        layer.data(), in.words.data(), in.offset, [&](std::int32_t sum) {
          const std::uint32_t value = armv6m_armv7m::stored<shift>(sum);
          *to++ = value;
          total += value;
        });
    out.offset = total << 15U;
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    finish_stores(in);
    std::int32_t* to = out.data();
    armv6m_armv7m::each_sum<Outputs, columns(Inputs)>(layer.data(), in.words.data(), in.offset,
                                                      [&](std::int32_t sum) { *to++ = sum; });
  }
};

}  // namespace striker::policy::kernel::int16

// The kernel for Armv7-M without the DSP extension (Cortex-M3) and Armv6-M (Cortex-M0+): two rows in a word.
//
// A word holds W = top * 2^16 + bottom, top a weight of the upper row, and bottom (0 to 65535) the lower
// row's weight plus 2^15. With T = sum of top * a and S = sum of W * a, all modulo 2^32,
//
//   upper row = T          lower row = S - T * 2^16 - 2^15 * sum of a
//
// so that one shift unpacks two weights, where a sign extension each would take two: 5 instructions for two
// products on Armv6-M, 3 on Armv7-M. The results are exact, as the proof shows that each row's sum fits 32
// bits. The sum of the activations is one number a layer. Activations take a word each.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/kernel/packing.hpp"
#include "firmware/policy/kernel/scaling.hpp"

namespace striker::policy::kernel {

namespace mla {

// Up to three pairs of rows: `both` is S, `top` is T. A row without a partner takes a word a weight, and S
// alone.
struct Sums {
  std::uint32_t both0 = 0, top0 = 0, both1 = 0, top1 = 0, both2 = 0, top2 = 0;
};

#if __ARM_ARCH >= 7

inline constexpr std::size_t greatest_group = 4;
inline constexpr std::size_t block_columns = 4;
inline constexpr std::size_t turn_columns = 4;  // that a row takes before the next row's turn

// The assembler drops what the block's shape does not need.
#define STRIKER_MLA_STEP(pair, word, activation)               \
  "mla %[both" pair "], " word ", " activation ", %[both" pair \
  "]\n\t"                                                      \
  ".if %c[rows] > 1\n\t"                                       \
  "asr " word ", " word                                        \
  ", #16\n\t"                                                  \
  "mla %[top" pair "], " word ", " activation ", %[top" pair   \
  "]\n\t"                                                      \
  ".endif\n\t"

#define STRIKER_MLA_ROWS(pair) \
  ".if %c[rows] > 2 * " pair                                                      \
  "\n\t"                                                                          \
  ".if %c[columns] == 4\n\t"                                                      \
  "ldmia %[weights]!, {r2, r3, r12, lr}\n\t"                                      \
  ".else\n\t"                                                                     \
  "ldmia %[weights]!, {r2, r3}\n\t"                                               \
  ".endif\n\t" STRIKER_MLA_STEP(pair, "r2", "r8") STRIKER_MLA_STEP(pair, "r3", "r9") \
  ".if %c[columns] == 4\n\t" STRIKER_MLA_STEP(pair, "r12", "r10") STRIKER_MLA_STEP(pair, "lr", "r11") \
  ".endif\n\t"                                                                    \
  ".endif\n\t"

// `Rows` rows (4, 2 or 1) take up the next 4 or 2 columns.
template <std::size_t Rows, std::size_t Columns>
[[gnu::always_inline]] inline void multiply_block(const std::uint32_t*& weights,
                                                  const std::uint32_t*& activations, Sums& sums) {
  auto [both0, top0, both1, top1, both2, top2] = sums;
  asm volatile(
      ".if %c[columns] == 4\n\t"
      "ldmia %[activations]!, {r8, r9, r10, r11}\n\t"
      ".else\n\t"
      "ldmia %[activations]!, {r8, r9}\n\t"
      ".endif\n\t"  //
      STRIKER_MLA_ROWS("0") STRIKER_MLA_ROWS("1")
      : [weights] "+r"(weights), [activations] "+r"(activations), [both0] "+r"(both0), [top0] "+r"(top0),
        [both1] "+r"(both1), [top1] "+r"(top1)
      : [rows] "i"(Rows), [columns] "i"(Columns)
      : "r2", "r3", "r8", "r9", "r10", "r11", "r12", "lr");
  sums = {both0, top0, both1, top1, both2, top2};
}

#undef STRIKER_MLA_STEP
#undef STRIKER_MLA_ROWS

// A group's first words are what its sums begin with.
template <std::size_t Rows>
[[gnu::always_inline]] inline Sums load_sums(const std::uint32_t*& weights) {
  Sums sums;
  if constexpr (Rows == 1) {
    sums.both0 = *weights++;
  }
  if constexpr (Rows >= 2) {
    asm volatile("ldrd %1, %2, [%0], #8" : "+r"(weights), "=r"(sums.both0), "=r"(sums.top0));
  }
  if constexpr (Rows >= 4) {
    asm volatile("ldrd %1, %2, [%0], #8" : "+r"(weights), "=r"(sums.both1), "=r"(sums.top1));
  }
  return sums;
}

#else

inline constexpr std::size_t greatest_group = 6;
inline constexpr std::size_t block_columns = 8;
inline constexpr std::size_t turn_columns = 2;  // that a row takes before the next row's turn

#define STRIKER_MLA_STEP(pair, word, activation) \
  ".if %c[rows] > 1\n\t"                         \
  "asrs r6, " word                               \
  ", #16\n\t"                                    \
  ".endif\n\t"                                   \
  "muls " word ", " activation                   \
  "\n\t"                                         \
  "add %[both" pair "], " word                   \
  "\n\t"                                         \
  ".if %c[rows] > 1\n\t"                         \
  "muls r6, " activation                         \
  "\n\t"                                         \
  "add %[top" pair                               \
  "], r6\n\t"                                    \
  ".endif\n\t"

#define STRIKER_MLA_ROWS(pair)                                         \
  ".if %c[rows] > 2 * " pair                                           \
  "\n\t"                                                               \
  "ldmia %[weights]!, {r4, r5}\n\t" STRIKER_MLA_STEP(pair, "r4", "r2") \
      STRIKER_MLA_STEP(pair, "r5", "r3") ".endif\n\t"

#define STRIKER_MLA_COLUMNS(first)                                                  \
  ".if %c[columns] > " first                                                        \
  "\n\t"                                                                            \
  "ldmia %[activations]!, {r2, r3}\n\t" STRIKER_MLA_ROWS("0") STRIKER_MLA_ROWS("1") \
      STRIKER_MLA_ROWS("2") ".endif\n\t"

// `Rows` rows (6, 4, 2 or 1) take up the next 8, 6, 4 or 2 columns. Multiplication wants the low registers;
// the sums are at home in the high ones, which ADD reaches.
template <std::size_t Rows, std::size_t Columns>
[[gnu::always_inline]] inline void multiply_block(const std::uint32_t*& weights,
                                                  const std::uint32_t*& activations, Sums& sums) {
  register std::uint32_t both0 asm("r8") = sums.both0;
  register std::uint32_t top0 asm("r9") = sums.top0;
  register std::uint32_t both1 asm("r10") = sums.both1;
  register std::uint32_t top1 asm("r11") = sums.top1;
  register std::uint32_t both2 asm("r12") = sums.both2;
  register std::uint32_t top2 asm("r7") = sums.top2;
  asm volatile(
      ".syntax unified\n\t"  //
      STRIKER_MLA_COLUMNS("0") STRIKER_MLA_COLUMNS("2") STRIKER_MLA_COLUMNS("4") STRIKER_MLA_COLUMNS("6")
      : [weights] "+l"(weights), [activations] "+l"(activations), [both0] "+r"(both0), [top0] "+r"(top0),
        [both1] "+r"(both1), [top1] "+r"(top1), [both2] "+r"(both2), [top2] "+r"(top2)
      : [rows] "i"(Rows), [columns] "i"(Columns)
      : "r2", "r3", "r4", "r5", "r6", "cc");
  sums = {both0, top0, both1, top1, both2, top2};
}

#undef STRIKER_MLA_STEP
#undef STRIKER_MLA_ROWS
#undef STRIKER_MLA_COLUMNS

// A group's first words are what its sums begin with.
template <std::size_t Rows>
[[gnu::always_inline]] inline Sums load_sums(const std::uint32_t*& weights) {
  const std::uint32_t* from = weights;
  weights += Rows;
  const auto word = [from](std::size_t i) { return i < Rows ? from[i] : 0; };
  return {word(0), word(1), word(2), word(3), word(4), word(5)};
}

#endif

// The sums of a group's rows, in their order.
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
  // Several groups a turn where they are small: there the loop's own instructions count.
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

}  // namespace mla

struct Mla {
  static constexpr const char* name = __ARM_ARCH >= 7 ? "mla" : "muls";

  static constexpr std::size_t columns(std::size_t inputs) { return round_up(inputs, 2); }

  // 2^15 times the sum of the values comes with them.
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

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    WordWriter<Packed<Inputs, Outputs>> stream;
    std::size_t group = 0;
    for (std::size_t first = 0; first < Outputs; first += group) {
      group = mla::next_group(Outputs - first);
      const std::size_t step = group == 1 ? 1 : 2;
      for (std::size_t row = first; row < first + group; row += step) {
        const auto lower = static_cast<std::uint32_t>(biases[row]);
        const std::uint32_t upper = group == 1 ? 0 : static_cast<std::uint32_t>(biases[row + 1]);
        stream.add(lower + (upper << 16U));
        if (group > 1) {
          stream.add(upper);
        }
      }
      for (std::size_t block = 0; block < columns(Inputs); block += mla::turn_columns) {
        for (std::size_t row = first; row < first + group; row += step) {
          for (std::size_t i = block; i < std::min(block + mla::turn_columns, columns(Inputs)); ++i) {
            const std::int32_t lower = weight_or_zero(layer, row, i);
            stream.add(group == 1 ? static_cast<std::uint32_t>(lower)
                                  : half_words(weight_or_zero(layer, row + 1, i), lower + (1 << 15)));
          }
        }
      }
    }
    return stream.words;
  }

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_hidden(const Layer<Inputs, Outputs>& layer) {
    return pack(layer, rounded_biases(layer));
  }
  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack_output(const Layer<Inputs, Outputs>& layer) {
    return pack(layer, layer.biases);
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    finish_stores(in);
    std::uint32_t* to = out.words.data();
    std::uint32_t total = 0;
    mla::each_sum<Outputs, columns(Inputs)>(layer.data(), in.words.data(), in.offset, [&](std::int32_t sum) {
      const std::uint32_t value = mla::stored<shift>(sum);
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
    mla::each_sum<Outputs, columns(Inputs)>(layer.data(), in.words.data(), in.offset,
                                            [&](std::int32_t sum) { *to++ = sum; });
  }
};

}  // namespace striker::policy::kernel

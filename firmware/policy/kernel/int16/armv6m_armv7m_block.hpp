// SPDX-License-Identifier: Apache-2.0
// The block of multiplications of the kernel in armv6m_armv7m.hpp: some rows and the next few columns.
//
// Of a block of one pair of rows and 2 columns, 4 products, the assembler makes on Armv7-M 8 instructions
// (with 4 columns, as in whole blocks, 14 for 8 products, and for the next pair of rows 13 more):
//
//   ldmia r7!, {r8, r9}                  the activations
//   ldmia r1!, {r2, r3}                  a word of both rows' weights for each column
//   mla   r4, r2, r8, r4                 both += W * a
//   asr   r2, r2, #16
//   mla   r6, r2, r8, r6                 top += (W >> 16) * a; and so, from r3 and r9, for the second column
//
// and on Armv6-M 12 (with three pairs of rows 34 for 12 products):
//
//   ldmia r0!, {r2, r3}                  the activations
//   ldmia r1!, {r4, r5}                  a word of both rows' weights for each column
//   asrs  r6, r4, #16
//   muls  r4, r2        add r8, r4       both += W * a
//   muls  r6, r2        add r9, r6       top += (W >> 16) * a; and so, from r5 and r3, for the second column
//
// A single row has a word a weight: there ASR and the second multiplication are left out.
#pragma once

#include <cstddef>
#include <cstdint>

namespace striker::policy::kernel::int16::armv6m_armv7m {

// The sums of up to three pairs of rows: of a pair, `both` is the prologue's S and `top` its T. A single row
// has `both` alone.
struct Sums {
  std::uint32_t both0 = 0, top0 = 0, both1 = 0, top1 = 0, both2 = 0, top2 = 0;
};

#if __ARM_ARCH >= 7

inline constexpr std::size_t greatest_group = 4;
inline constexpr std::size_t block_columns = 4;
inline constexpr std::size_t turn_columns = 4;  // that a row takes before the next row's turn

// The texts of a pair of rows and one column, and of a pair of rows and all of a block's columns. The
// assembler drops what the block's shape does not need.
// clang-format off
#define STRIKER_ARMV7M_STEP(pair, word, activation)                    \
  "mla %[both" pair "], " word ", " activation ", %[both" pair "]\n\t" \
  ".if %c[rows] > 1\n\t"                                               \
  "asr " word ", " word ", #16\n\t"                                    \
  "mla %[top" pair "], " word ", " activation ", %[top" pair "]\n\t"   \
  ".endif\n\t"

#define STRIKER_ARMV7M_ROWS(pair)              \
  ".if %c[rows] > 2 * " pair "\n\t"            \
  ".if %c[columns] == 4\n\t"                   \
  "ldmia %[weights]!, {r2, r3, r12, lr}\n\t"   \
  ".else\n\t"                                  \
  "ldmia %[weights]!, {r2, r3}\n\t"            \
  ".endif\n\t"                                 \
  STRIKER_ARMV7M_STEP(pair, "r2", "r8")        \
  STRIKER_ARMV7M_STEP(pair, "r3", "r9")        \
  ".if %c[columns] == 4\n\t"                   \
  STRIKER_ARMV7M_STEP(pair, "r12", "r10")      \
  STRIKER_ARMV7M_STEP(pair, "lr", "r11")       \
  ".endif\n\t"                                 \
  ".endif\n\t"
// clang-format on

// Adds the products of `Rows` rows (4, 2 or 1) and the next 4 or 2 columns to the rows' sums.
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
      STRIKER_ARMV7M_ROWS("0") STRIKER_ARMV7M_ROWS("1")
      : [weights] "+r"(weights), [activations] "+r"(activations), [both0] "+r"(both0), [top0] "+r"(top0),
        [both1] "+r"(both1), [top1] "+r"(top1)
      : [rows] "i"(Rows), [columns] "i"(Columns)
      : "r2", "r3", "r8", "r9", "r10", "r11", "r12", "lr");
  sums = {both0, top0, both1, top1, both2, top2};
}

#undef STRIKER_ARMV7M_STEP
#undef STRIKER_ARMV7M_ROWS

// What a group's sums begin with: its first words.
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

// The texts of a pair of rows and one column, of a pair of rows and two columns, and of all rows and the two
// columns from `first` on. The assembler drops what the block's shape does not need.
// clang-format off
#define STRIKER_ARMV6M_STEP(pair, word, activation) \
  ".if %c[rows] > 1\n\t"                            \
  "asrs r6, " word ", #16\n\t"                      \
  ".endif\n\t"                                      \
  "muls " word ", " activation "\n\t"               \
  "add %[both" pair "], " word "\n\t"               \
  ".if %c[rows] > 1\n\t"                            \
  "muls r6, " activation "\n\t"                     \
  "add %[top" pair "], r6\n\t"                      \
  ".endif\n\t"

#define STRIKER_ARMV6M_ROWS(pair)                   \
  ".if %c[rows] > 2 * " pair "\n\t"                 \
  "ldmia %[weights]!, {r4, r5}\n\t"                 \
  STRIKER_ARMV6M_STEP(pair, "r4", "r2")             \
  STRIKER_ARMV6M_STEP(pair, "r5", "r3")             \
  ".endif\n\t"

#define STRIKER_ARMV6M_COLUMNS(first)               \
  ".if %c[columns] > " first "\n\t"                 \
  "ldmia %[activations]!, {r2, r3}\n\t"             \
  STRIKER_ARMV6M_ROWS("0")                          \
  STRIKER_ARMV6M_ROWS("1")                          \
  STRIKER_ARMV6M_ROWS("2")                          \
  ".endif\n\t"
// clang-format on

// Adds the products of `Rows` rows (6, 4, 2 or 1) and the next 8, 6, 4 or 2 columns to the rows' sums.
// Multiplication wants the low registers; the sums are at home in the high ones, which ADD reaches.
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
      STRIKER_ARMV6M_COLUMNS("0") STRIKER_ARMV6M_COLUMNS("2") STRIKER_ARMV6M_COLUMNS("4")
          STRIKER_ARMV6M_COLUMNS("6")
      : [weights] "+l"(weights), [activations] "+l"(activations), [both0] "+r"(both0), [top0] "+r"(top0),
        [both1] "+r"(both1), [top1] "+r"(top1), [both2] "+r"(both2), [top2] "+r"(top2)
      : [rows] "i"(Rows), [columns] "i"(Columns)
      : "r2", "r3", "r4", "r5", "r6", "cc");
  sums = {both0, top0, both1, top1, both2, top2};
}

#undef STRIKER_ARMV6M_STEP
#undef STRIKER_ARMV6M_ROWS
#undef STRIKER_ARMV6M_COLUMNS

// What a group's sums begin with: its first words.
template <std::size_t Rows>
[[gnu::always_inline]] inline Sums load_sums(const std::uint32_t*& weights) {
  const std::uint32_t* from = weights;
  weights += Rows;
  const auto word = [from](std::size_t i) { return i < Rows ? from[i] : 0; };
  return {word(0), word(1), word(2), word(3), word(4), word(5)};
}

#endif

}  // namespace striker::policy::kernel::int16::armv6m_armv7m

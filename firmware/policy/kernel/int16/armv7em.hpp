// SPDX-License-Identifier: Apache-2.0
// The kernel for int16 weights and cores with the DSP extension (Armv7E-M, and Armv8-M and Armv7-R with it):
// Cortex-M4, M7, M33 and R5.
//
// SMLAD multiplies two pairs of half-words and adds both products. Four rows share the activations; LDM loads
// four words an instruction, which GCC 12 does not make of intrinsics (it loads word by word). Activations
// lie two in a word. USAT with a shift is rescaling, ReLU and saturation at once.
//
// A layer's words are groups of four rows, and one of 1 to 3 for what is left: a group's biases, then, for
// one block of 4 pairs of columns after another, its rows' weights (fewer pairs in the last block). Of a
// block of 4 rows and 4 pairs the assembler makes 21 instructions for 32 products, with all 14 registers in
// use:
//
//   ldmia r7!, {r8, r9, r10, r11}                    the activations of 8 columns
//   ldmia r1!, {r2, r3, r12, lr}                     row 0's weights of them
//   smlad r4, r2, r8, r4         smlad r4, r3, r9, r4
//   smlad r4, r12, r10, r4       smlad r4, lr, r11, r4
//                                                    and so for rows 1 to 3, whose sums are in r6, r0 and r5
//
// A block of 1 row and 2 pairs is: ldmia r7!, {r8, r9}; ldmia r1!, {r2, r3}; and two SMLAD.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int16 {

namespace armv7em {

template <std::size_t Rows>
struct Sums {
  std::int32_t s0, s1, s2, s3;  // the first `Rows` of them
};

// The text of one row of a block, if the block has it: load its weights, and multiply them by the activations
// in r8 to r11. The assembler drops what the block's shape does not need.
// clang-format off
#define STRIKER_ARMV7EM_ROW(row, sum)                              \
  ".if %c[rows] > " row "\n\t"                                     \
  ".if %c[pairs] == 4\n\t"                                         \
  "ldmia %[weights]!, {r2, r3, r12, lr}\n\t"                       \
  ".elseif %c[pairs] == 3\n\t"                                     \
  "ldmia %[weights]!, {r2, r3, r12}\n\t"                           \
  ".elseif %c[pairs] == 2\n\t"                                     \
  "ldmia %[weights]!, {r2, r3}\n\t"                                \
  ".else\n\t"                                                      \
  "ldr r2, [%[weights]], #4\n\t"                                   \
  ".endif\n\t"                                                     \
  "smlad " sum ", r2, r8, " sum "\n\t"                             \
  ".if %c[pairs] > 1\n\t"                                          \
  "smlad " sum ", r3, r9, " sum "\n\t"                             \
  ".endif\n\t"                                                     \
  ".if %c[pairs] > 2\n\t"                                          \
  "smlad " sum ", r12, r10, " sum "\n\t"                           \
  ".endif\n\t"                                                     \
  ".if %c[pairs] > 3\n\t"                                          \
  "smlad " sum ", lr, r11, " sum "\n\t"                            \
  ".endif\n\t"                                                     \
  ".endif\n\t"

// The text of a block. Its arguments are the registers that it overwrites.
#define STRIKER_ARMV7EM_BLOCK(...)                                                                \
  asm volatile(                                                                                   \
      ".if %c[pairs] == 4\n\t"                                                                    \
      "ldmia %[activations]!, {r8, r9, r10, r11}\n\t"                                             \
      ".elseif %c[pairs] == 3\n\t"                                                                \
      "ldmia %[activations]!, {r8, r9, r10}\n\t"                                                  \
      ".elseif %c[pairs] == 2\n\t"                                                                \
      "ldmia %[activations]!, {r8, r9}\n\t"                                                       \
      ".else\n\t"                                                                                 \
      "ldr r8, [%[activations]], #4\n\t"                                                          \
      ".endif\n\t"                                                                                \
      STRIKER_ARMV7EM_ROW("0", "%[s0]")                                                           \
      STRIKER_ARMV7EM_ROW("1", "%[s1]")                                                           \
      STRIKER_ARMV7EM_ROW("2", "%[s2]")                                                           \
      STRIKER_ARMV7EM_ROW("3", "%[s3]")                                                           \
      : [weights] "+r"(weights), [activations] "+r"(activations), [s0] "+r"(s0), [s1] "+r"(s1),   \
        [s2] "+r"(s2), [s3] "+r"(s3)                                                              \
      : [rows] "i"(Rows), [pairs] "i"(Pairs)                                                      \
      : __VA_ARGS__)
// clang-format on

// Adds the products of `Rows` rows and the next `Pairs` pairs of columns to the rows' sums; both are at most
// 4. LDM fills registers in their order: those are fixed, and the sums' and pointers' are the compiler's
// choice.
template <std::size_t Rows, std::size_t Pairs>
[[gnu::always_inline]] inline void multiply_block(const std::uint32_t*& weights,
                                                  const std::uint32_t*& activations, Sums<Rows>& sums) {
  auto [s0, s1, s2, s3] = sums;
  if constexpr (Pairs == 4) {
    STRIKER_ARMV7EM_BLOCK("r2", "r3", "r8", "r9", "r10", "r11", "r12", "lr");
  } else {
    STRIKER_ARMV7EM_BLOCK("r2", "r3", "r8", "r9", "r10", "r12");
  }
  sums = {s0, s1, s2, s3};
}

#undef STRIKER_ARMV7EM_ROW
#undef STRIKER_ARMV7EM_BLOCK

struct Two {
  std::int32_t first, second;
};

// Two words with one instruction. The pointer has to be a multiple of 4 only.
[[gnu::always_inline]] inline Two load_two(const std::uint32_t*& from) {
  std::int32_t first;
  std::int32_t second;
  asm volatile("ldrd %1, %2, [%0], #8" : "+r"(from), "=r"(first), "=r"(second));
  return {first, second};
}

// The sums of a group's rows; `weights` is left at the next group.
template <std::size_t Rows, std::size_t Pairs>
[[gnu::always_inline]] inline Sums<Rows> group_sums(const std::uint32_t*& weights,
                                                    const std::uint32_t* activations) {
  Sums<Rows> sums{};
  if constexpr (Rows == 4) {
    const auto [s0, s1] = load_two(weights);
    const auto [s2, s3] = load_two(weights);
    sums = {s0, s1, s2, s3};
  } else {
    const auto bias = [from = weights](std::size_t row) {
      return row < Rows ? static_cast<std::int32_t>(from[row]) : 0;
    };
    sums = {bias(0), bias(1), bias(2), 0};
    weights += Rows;
  }
#pragma GCC unroll 8
  for (std::size_t block = 0; block < Pairs / 4; ++block) {
    multiply_block<Rows, 4>(weights, activations, sums);
  }
  if constexpr (Pairs % 4 != 0) {
    multiply_block<Rows, Pairs % 4>(weights, activations, sums);
  }
  return sums;
}

// A sum as it is stored: rescaled, not below 0, not above 32767.
template <int shift>
[[gnu::always_inline]] inline std::uint32_t stored(std::int32_t sum) {
  std::uint32_t value;
  asm("usat %0, #15, %1, asr %2" : "=r"(value) : "r"(sum), "i"(shift));
  return value;
}

// Computes and stores a group of four hidden neurons.
template <int shift, std::size_t Pairs>
[[gnu::always_inline]] inline void store_group(const std::uint32_t*& weights,
                                               const std::uint32_t* activations, std::uint32_t* to) {
  const auto sums = group_sums<4, Pairs>(weights, activations);
  to[0] = stored<shift>(sums.s0) | stored<shift>(sums.s1) << 16U;
  to[1] = stored<shift>(sums.s2) | stored<shift>(sums.s3) << 16U;
}

}  // namespace armv7em

struct Armv7em {
  static constexpr const char* name = "int16/armv7em";
  static constexpr bool rounds = false;
  static constexpr std::size_t group_rows = 4;

  static constexpr std::size_t pairs(std::size_t inputs) { return (inputs + 1) / 2; }

  template <std::size_t Count>
  struct Activations : WordBuffer<pairs(Count)> {
    void set(std::size_t i, std::int32_t value) {
      std::uint32_t& word = this->words[i / 2];
      const auto half = static_cast<std::uint32_t>(value) & 0xFFFFU;
      word = i % 2 == 0 ? half : word | half << 16U;
    }
  };

  template <std::size_t Inputs, std::size_t Outputs>
  using Packed = std::array<std::uint32_t, Outputs*(1 + pairs(Inputs))>;

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    WordWriter<Packed<Inputs, Outputs>> packed;
    for (std::size_t first = 0; first < Outputs; first += group_rows) {
      const std::size_t end = std::min(first + group_rows, Outputs);
      for (std::size_t row = first; row < end; ++row) {
        packed.add(biases[row]);
      }
      for (std::size_t block = 0; block < pairs(Inputs); block += 4) {
        for (std::size_t row = first; row < end; ++row) {
          for (std::size_t p = block; p < std::min(block + 4, pairs(Inputs)); ++p) {
            packed.add(half_words(weight_or_zero(layer, row, 2 * p + 1), layer.weights[row][2 * p]));
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
    const std::uint32_t* weights = layer.data();
    std::uint32_t* to = out.words.data();
    // Where groups are small the loop's own instructions count: there a turn takes several groups.
    constexpr std::size_t all_groups = Outputs / group_rows;
    constexpr std::size_t groups = pairs(Inputs) <= 8 ? 4 : pairs(Inputs) <= 32 ? 2 : 1;
    for (const std::uint32_t* end = to + all_groups / groups * groups * 2; to != end; to += 2 * groups) {
#pragma GCC unroll 4
      for (std::size_t group = 0; group < groups; ++group) {
        armv7em::store_group<shift, pairs(Inputs)>(weights, in.words.data(), to + 2 * group);
      }
    }
    for (std::size_t group = 0; group < all_groups % groups; ++group) {
      armv7em::store_group<shift, pairs(Inputs)>(weights, in.words.data(), to + 2 * group);
    }
    if constexpr (constexpr std::size_t rest = Outputs % group_rows; rest != 0) {
      const auto sums = armv7em::group_sums<rest, pairs(Inputs)>(weights, in.words.data());
      const std::array<std::int32_t, 3> values = {sums.s0, sums.s1, sums.s2};
      for (std::size_t r = 0; r < rest; ++r) {
        out.set(Outputs - rest + r, static_cast<std::int32_t>(armv7em::stored<shift>(values[r])));
      }
    }
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    finish_stores(in);
    const std::uint32_t* weights = layer.data();
    std::int32_t* to = out.data();
    for (std::size_t row = 0; row + group_rows <= Outputs; row += group_rows) {
      const auto group = armv7em::group_sums<group_rows, pairs(Inputs)>(weights, in.words.data());
      to[row] = group.s0;
      to[row + 1] = group.s1;
      to[row + 2] = group.s2;
      to[row + 3] = group.s3;
    }
    if constexpr (constexpr std::size_t rest = Outputs % group_rows; rest != 0) {
      const auto group = armv7em::group_sums<rest, pairs(Inputs)>(weights, in.words.data());
      const std::array<std::int32_t, 3> values = {group.s0, group.s1, group.s2};
      std::copy_n(values.begin(), rest, out.end() - rest);
    }
  }
};

}  // namespace striker::policy::kernel::int16

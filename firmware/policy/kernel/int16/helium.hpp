// SPDX-License-Identifier: Apache-2.0
// The kernel for int16 weights and the M-profile Vector Extension (Helium): Cortex-M55.
//
// VMLADAVA multiplies eight pairs of half-words and adds all products to a general register. VLDM loads four
// vectors an instruction; four rows share the activations. A hidden layer's sums are rescaled afterwards,
// eight at a time: VQRSHRN shifts, rounds and saturates, VMAX is ReLU. (Not VQSHRN with the rounding in the
// bias: GNU as 2.40 assembles it as VQRSHRN.)
//
// Weights and activations lie in vectors of 8 columns, the last one filled up with weights of 0. In a group
// of four rows one block of 4 vectors comes after another, in each the rows one after the other. Of a block
// of 4 rows and 4 vectors the assembler makes 21 instructions for 128 products:
//
//   vldmia r5!, {d8-d15}                             the activations of 32 columns, in q4 to q7
//   vldmia r3!, {d0-d7}                              row 0's weights of them, in q0 to q3
//   vmladava.s16 r0, q0, q4      vmladava.s16 r0, q1, q5
//   vmladava.s16 r0, q2, q6      vmladava.s16 r0, q3, q7
//                                                    and so for rows 1 to 3, whose sums are in r2, r4 and r6
//
// Layers of one vector, and of four, keep their activations in registers for all rows: a group of four rows
// of one vector is a VLDMIA and four VMLADAVA.
#pragma once

#include <arm_mve.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int16 {

namespace helium {

inline constexpr std::size_t lanes = 8;
inline constexpr std::size_t block_vectors = 4;
inline constexpr std::size_t group_rows = 4;

struct Sums {
  std::int32_t s0, s1, s2, s3;
};

// The text of one row of a block, if the block has it. The assembler drops what the block's shape does not
// need.
// clang-format off
#define STRIKER_HELIUM_ROW(row, sum)              \
  ".if %c[rows] > " row "\n\t"                    \
  "vldmia %[weights]!, {d0-d%c[last_weight]}\n\t" \
  "vmladava.s16 " sum ", q0, q4\n\t"              \
  ".if %c[vectors] > 1\n\t"                       \
  "vmladava.s16 " sum ", q1, q5\n\t"              \
  ".endif\n\t"                                    \
  ".if %c[vectors] > 2\n\t"                       \
  "vmladava.s16 " sum ", q2, q6\n\t"              \
  ".endif\n\t"                                    \
  ".if %c[vectors] > 3\n\t"                       \
  "vmladava.s16 " sum ", q3, q7\n\t"              \
  ".endif\n\t"                                    \
  ".endif\n\t"
// clang-format on

// Adds the products of `Rows` rows and the next `Vectors` vectors of columns to the rows' sums; both are at
// most 4. VMLADAVA wants its sums in even registers ("Te").
template <std::size_t Rows, std::size_t Vectors>
[[gnu::always_inline]] inline void multiply_block(const std::int16_t*& weights,
                                                  const std::int16_t*& activations, Sums& sums) {
  auto [s0, s1, s2, s3] = sums;
  asm volatile("vldmia %[activations]!, {d8-d%c[last_activation]}\n\t"  //
               STRIKER_HELIUM_ROW("0", "%[s0]") STRIKER_HELIUM_ROW("1", "%[s1]")
                   STRIKER_HELIUM_ROW("2", "%[s2]") STRIKER_HELIUM_ROW("3", "%[s3]")
               : [weights] "+r"(weights), [activations] "+r"(activations), [s0] "+Te"(s0), [s1] "+Te"(s1),
                 [s2] "+Te"(s2), [s3] "+Te"(s3)
               : [rows] "i"(Rows), [vectors] "i"(Vectors), [last_weight] "i"(2 * Vectors - 1),
                 [last_activation] "i"(7 + 2 * Vectors)
               : "d0", "d1", "d2", "d3", "d4", "d5", "d6", "d7", "d8", "d9", "d10", "d11", "d12", "d13",
                 "d14", "d15");
  sums = {s0, s1, s2, s3};
}

#undef STRIKER_HELIUM_ROW

// Adds the products of four rows of one vector each, all of which one load brings. The activations stay in
// their register.
[[gnu::always_inline]] inline void multiply_short_rows(const std::int16_t*& weights, int16x8_t activations,
                                                       Sums& sums) {
  auto [s0, s1, s2, s3] = sums;
  asm volatile(
      "vldmia %[weights]!, {d0-d7}\n\t"
      "vmladava.s16 %[s0], q0, %q[activations]\n\t"
      "vmladava.s16 %[s1], q1, %q[activations]\n\t"
      "vmladava.s16 %[s2], q2, %q[activations]\n\t"
      "vmladava.s16 %[s3], q3, %q[activations]"
      : [weights] "+r"(weights), [s0] "+Te"(s0), [s1] "+Te"(s1), [s2] "+Te"(s2), [s3] "+Te"(s3)
      : [activations] "w"(activations)
      : "d0", "d1", "d2", "d3", "d4", "d5", "d6", "d7");
  sums = {s0, s1, s2, s3};
}

// Adds the products of one row of four vectors. The activations stay in their four registers.
[[gnu::always_inline]] inline void multiply_held_row(const std::int16_t*& weights,
                                                     const std::array<int16x8_t, block_vectors>& activations,
                                                     std::int32_t& sum) {
  asm volatile(
      "vldmia %[weights]!, {d0-d7}\n\t"
      "vmladava.s16 %[sum], q0, %q[a0]\n\t"
      "vmladava.s16 %[sum], q1, %q[a1]\n\t"
      "vmladava.s16 %[sum], q2, %q[a2]\n\t"
      "vmladava.s16 %[sum], q3, %q[a3]"
      : [weights] "+r"(weights), [sum] "+Te"(sum)
      : [a0] "w"(activations[0]), [a1] "w"(activations[1]), [a2] "w"(activations[2]), [a3] "w"(activations[3])
      : "d0", "d1", "d2", "d3", "d4", "d5", "d6", "d7");
}

// Four biases with one instruction, into even registers, where VMLADAVA wants its sums.
[[gnu::always_inline]] inline Sums load_four(const std::int32_t*& from) {
  register std::int32_t s0 asm("r0");
  register std::int32_t s1 asm("r2");
  register std::int32_t s2 asm("r4");
  register std::int32_t s3 asm("r6");
  asm volatile("ldmia %[from]!, {r0, r2, r4, r6}"
               : [from] "+r"(from), "=r"(s0), "=r"(s1), "=r"(s2), "=r"(s3));
  return {s0, s1, s2, s3};
}

// Four sums into memory, out of the same registers.
[[gnu::always_inline]] inline void store_four(std::int32_t*& to, const Sums& sums) {
  register std::int32_t s0 asm("r0") = sums.s0;
  register std::int32_t s1 asm("r2") = sums.s1;
  register std::int32_t s2 asm("r4") = sums.s2;
  register std::int32_t s3 asm("r6") = sums.s3;
  asm volatile("stmia %[to]!, {r0, r2, r4, r6}"
               : [to] "+r"(to)
               : "r"(s0), "r"(s1), "r"(s2), "r"(s3)
               : "memory");
}

// Adds the products of `Rows` rows and all columns, block by block.
template <std::size_t Rows, std::size_t Vectors>
[[gnu::always_inline]] inline void multiply_row_blocks(const std::int16_t*& weights,
                                                       const std::int16_t* activations, Sums& sums) {
#pragma GCC unroll 8
  for (std::size_t block = 0; block < Vectors / block_vectors; ++block) {
    multiply_block<Rows, block_vectors>(weights, activations, sums);
  }
  if constexpr (Vectors % block_vectors != 0) {
    multiply_block<Rows, Vectors % block_vectors>(weights, activations, sums);
  }
}

// The sums of all of a layer's rows, in their order.
template <std::size_t Rows, std::size_t Vectors>
[[gnu::always_inline]] inline void layer_sums(const std::int16_t* weights, const std::int16_t* activations,
                                              const std::int32_t* biases, std::int32_t* to) {
  std::array<int16x8_t, block_vectors> held{};
  if constexpr (Vectors == 1 || Vectors == block_vectors) {
    for (std::size_t v = 0; v < Vectors; ++v) {
      held[v] = vld1q_s16(activations + v * lanes);
    }
  }
#pragma GCC unroll 4
  for (std::size_t group = 0; group < Rows / group_rows; ++group) {
    Sums sums = load_four(biases);
    if constexpr (Vectors == 1) {
      multiply_short_rows(weights, held[0], sums);
    } else if constexpr (Vectors == block_vectors) {
      multiply_held_row(weights, held, sums.s0);
      multiply_held_row(weights, held, sums.s1);
      multiply_held_row(weights, held, sums.s2);
      multiply_held_row(weights, held, sums.s3);
    } else {
      multiply_row_blocks<group_rows, Vectors>(weights, activations, sums);
    }
    store_four(to, sums);
  }
  if constexpr (constexpr std::size_t rest = Rows % group_rows; rest != 0) {
    Sums sums{biases[0], rest > 1 ? biases[1] : 0, rest > 2 ? biases[2] : 0, 0};
    multiply_row_blocks<rest, Vectors>(weights, activations, sums);
    const std::array<std::int32_t, 3> values = {sums.s0, sums.s1, sums.s2};
    std::copy_n(values.begin(), rest, to);
  }
}

// Stores sums as activations, eight at a time: rescaled with rounding, not below 0, not above 32767. VQRSHRN
// shifts by at most 16, so a greater shift begins with an ordinary one. It fills every other lane, from two
// vectors that a de-interleaving load made.
template <int shift, std::size_t Count>
[[gnu::always_inline]] inline void store_all(const std::int32_t* sums, std::int16_t* to) {
  constexpr int last_shift = std::min(shift, 16);
  const int16x8_t zero = vdupq_n_s16(0);
  int16x8_t stored = zero;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < Count; i += lanes) {
    int32x4x2_t pair = vld2q_s32(sums + i);
    if constexpr (shift > last_shift) {
      pair.val[0] = vshrq_n_s32(pair.val[0], shift - last_shift);
      pair.val[1] = vshrq_n_s32(pair.val[1], shift - last_shift);
    }
    stored = vqrshrnbq_n_s32(stored, pair.val[0], last_shift);
    stored = vqrshrntq_n_s32(stored, pair.val[1], last_shift);
    stored = vmaxq_s16(stored, zero);
    vst1q_s16(to + i, stored);
  }
}

}  // namespace helium

struct Helium {
  static constexpr const char* name = "int16/helium";
  static constexpr bool rounds = true;  // by VQRSHRN, in store_all()

  static constexpr std::size_t columns(std::size_t inputs) { return round_up(inputs, helium::lanes); }

  // What lies past `Count` does not matter: the weights of those columns are 0.
  template <std::size_t Count>
  struct Activations {
    alignas(16) std::array<std::int16_t, columns(Count)> values;
    void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  template <std::size_t Inputs, std::size_t Outputs>
  struct Packed {
    alignas(16) std::array<std::int16_t, Outputs * columns(Inputs)> weights{};
    std::array<std::int32_t, round_up(Outputs, 4)> biases{};  // without padding: they are hashed at run time
  };

  template <Role, std::size_t Inputs, std::size_t Outputs>
  static constexpr Packed<Inputs, Outputs> pack(const Layer<Inputs, Outputs>& layer,
                                                const std::array<std::int32_t, Outputs>& biases) {
    constexpr std::size_t block_columns = helium::lanes * helium::block_vectors;
    Packed<Inputs, Outputs> packed;
    std::copy(biases.begin(), biases.end(), packed.biases.begin());
    std::size_t at = 0;
    for (std::size_t first = 0; first < Outputs; first += helium::group_rows) {
      for (std::size_t block = 0; block < columns(Inputs); block += block_columns) {
        for (std::size_t row = first; row < std::min(first + helium::group_rows, Outputs); ++row) {
          for (std::size_t i = block; i < std::min(block + block_columns, columns(Inputs)); ++i) {
            packed.weights[at++] = static_cast<std::int16_t>(weight_or_zero(layer, row, i));
          }
        }
      }
    }
    return packed;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const Packed<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    alignas(16) std::array<std::int32_t, columns(Outputs)> sums;
    finish_stores(in);
    helium::layer_sums<Outputs, columns(Inputs) / helium::lanes>(layer.weights.data(), in.values.data(),
                                                                 layer.biases.data(), sums.data());
    helium::store_all<shift, columns(Outputs)>(sums.data(), out.values.data());
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const Packed<Inputs, Outputs>& layer, const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    finish_stores(in);
    helium::layer_sums<Outputs, columns(Inputs) / helium::lanes>(layer.weights.data(), in.values.data(),
                                                                 layer.biases.data(), out.data());
  }
};

}  // namespace striker::policy::kernel::int16

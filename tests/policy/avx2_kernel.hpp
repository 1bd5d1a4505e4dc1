// SPDX-License-Identifier: Apache-2.0
// The int16 kernel with AVX2's vectors of 256 bits, for the tests and benchmarks that show what the processor
// can do. The firmware's Linux build takes SSE2: it has to run on any x86-64, and decides every 50 ms.
//
// It is the kernel of firmware/policy/kernel/int16/x86.hpp with twice the lanes, and scales the inputs eight
// at a time where their shifts let it. avx2::infer<policy>(raw) is to it what infer<policy>(raw) is to the
// others: the same bits, in the same number of instructions for every input.
#pragma once

#ifndef __AVX2__
#error "avx2_kernel.hpp: compile with -mavx2 or -march=x86-64-v3"
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/argmax.hpp"
#include "firmware/policy/kernel/int16/x86.hpp"
#include "firmware/policy/kernel/packing.hpp"
#include "firmware/policy/kernel/scaling.hpp"
#include "firmware/policy/network.hpp"

namespace striker::policy::avx2 {

using kernel::int16::x86::vector_at;

// What the kernel of firmware/policy/kernel/int16/x86.hpp needs to know of vectors of 256 bits.
struct Vectors {
  static constexpr const char* name = "int16/avx2";
  using Words [[gnu::vector_size(32)]] = int;
  using Halves [[gnu::vector_size(32)]] = short;
  using Quad [[gnu::vector_size(16)]] = int;

  // Assembly, as GCC 12 folds no load into VPMADDWD and re-associates the additions until it has to spill.
  static Words multiply(Words a, const Words& b) {
    Words products;
    asm("vpmaddwd %[b], %[a], %[products]" : [products] "=x"(products) : [a] "x"(a), [b] "m"(b));
    return products;
  }
  static void multiply_add(Words& sum, Words a, const Words& b) {
    Words products;
    asm("vpmaddwd %[b], %[a], %[products]\n\tvpaddd %[products], %[sum], %[sum]"
        : [sum] "+x"(sum), [products] "=&x"(products)
        : [a] "x"(a), [b] "m"(b));
  }
  // The instruction works within 128-bit halves: so row_of() lets rows change places.
  static Halves narrow(Words low, Words high) { return __builtin_ia32_packssdw256(low, high); }
  static constexpr std::size_t row_of(std::size_t lane) { return lane % 4 + lane / 4 % 2 * 8 + lane / 8 * 4; }
  static Quad fold(Words v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  }
};

// Scales eight inputs at a time, as kernel::scale_input() does one: the even lanes' 64-bit products, and then
// the odd ones'. Of a shifted product only the lower word is taken, so that a scale's shift must not be
// beyond 32.
template <std::size_t Inputs>
struct InputScaler {
  static constexpr std::size_t lanes = 8;
  using Words = Vectors::Words;
  using Wide [[gnu::vector_size(32)]] = long long;
  using UnsignedWide [[gnu::vector_size(32)]] = unsigned long long;

  static constexpr std::size_t padded = kernel::round_up(Inputs, lanes);
  alignas(32) std::array<std::int32_t, padded> there{};  // all ones where there is an input
  alignas(32) std::array<std::int32_t, padded> least{}, greatest{}, multiplier{};
  alignas(32) std::array<std::int64_t, padded / 2> even_half{}, odd_half{}, even_shift{}, odd_shift{};

  constexpr explicit InputScaler(const std::array<InputScale, Inputs>& scales) {
    for (std::size_t i = 0; i < Inputs; ++i) {
      const int bits = kernel::relevant_bits(scales[i]);
      there[i] = -1;
      greatest[i] = static_cast<std::int32_t>((std::int64_t{1} << bits) - 1);
      least[i] = -greatest[i] - 1;
      multiplier[i] = scales[i].multiplier;
      (i % 2 == 0 ? even_half : odd_half)[i / 2] = std::int64_t{1} << (scales[i].shift - 1);
      (i % 2 == 0 ? even_shift : odd_shift)[i / 2] = i % 2 == 0 ? scales[i].shift : 32 - scales[i].shift;
    }
  }

  static constexpr bool can_scale(const std::array<InputScale, Inputs>& scales) {
    return std::all_of(scales.begin(), scales.end(),
                       [](const InputScale& scale) { return scale.shift <= 32; });
  }

  // Writes all columns of the activations.
  [[gnu::always_inline]] void scale(const std::array<std::int32_t, Inputs>& raw, std::int16_t* to) const {
    using Halves = Vectors::Halves;
#pragma GCC unroll 2
    for (std::size_t i = 0; i < padded; i += 2 * lanes) {
      const Words low = scaled(raw, i);
      const Words high = i + lanes < padded ? scaled(raw, i + lanes) : Words{};
      // The packing instruction works within 128-bit halves.
      const auto packed = reinterpret_cast<Wide>(Vectors::narrow(low, high));
      const auto halves = reinterpret_cast<Halves>(__builtin_shufflevector(packed, packed, 0, 2, 1, 3));
      Halves limit = Halves{} - static_cast<short>(kernel::greatest_activation);
      asm("" : "+x"(limit));  // of a constant that it knows, GCC 12 makes a comparison and a blend
      const Halves stored = halves > limit ? halves : limit;
      __builtin_memcpy(to + i, &stored, sizeof stored);
    }
  }

 private:
  // The activations of eight inputs, still in words, and not yet limited to -32767.
  [[gnu::always_inline]] Words scaled(const std::array<std::int32_t, Inputs>& raw, std::size_t i) const {
    // A copy that fills up with zeros would be stored in pieces: no store is forwarded to a wider load.
    // The load needs no alignment, and the caller's inputs have none.
    const Words above = __builtin_ia32_maskloadd256(reinterpret_cast<const Words*>(raw.data() + i),
                                                    vector_at<Words>(there.data() + i));
    const Words low = vector_at<Words>(least.data() + i);
    const Words high = vector_at<Words>(greatest.data() + i);
    const Words at_least_low = above > low ? above : low;
    const Words in = at_least_low < high ? at_least_low : high;
    const Words factor = vector_at<Words>(multiplier.data() + i);
    const Wide even = product(in, factor) + vector_at<Wide>(even_half.data() + i / 2);
    const Wide odd = product(upper(in), upper(factor)) + vector_at<Wide>(odd_half.data() + i / 2);
    const auto even_word = reinterpret_cast<Words>(reinterpret_cast<UnsignedWide>(even) >>
                                                   vector_at<UnsignedWide>(even_shift.data() + i / 2));
    const auto odd_word = reinterpret_cast<Words>(odd << vector_at<Wide>(odd_shift.data() + i / 2));
    return __builtin_shufflevector(even_word, odd_word, 0, 9, 2, 11, 4, 13, 6, 15);
  }
  static Wide product(Words a, Words b) {
    return __builtin_ia32_pmuldq256(a, b);
  }
  static Words upper(Words both) {
    return reinterpret_cast<Words>(reinterpret_cast<UnsignedWide>(both) >> 32);
  }
};

using Kernel = kernel::int16::x86::Kernel<Vectors>;

// The network's answer to raw inputs, scaled all at once where the policy's scales let it.
template <const auto& policy>
[[nodiscard, gnu::noinline]] auto infer(const std::array<std::int32_t, ShapeOf<policy>::inputs>& raw) {
  using Shape = ShapeOf<policy>;
  if constexpr (!InputScaler<Shape::inputs>::can_scale(policy.input_scales)) {
    return striker::policy::infer<policy, Kernel>(raw);
  } else {
    static constexpr InputScaler<Shape::inputs> scaler(policy.input_scales);
    Kernel::Activations<Shape::inputs> inputs;
    scaler.scale(raw, inputs.values.data());
    QValues<Shape::actions> q;
    propagate<policy, Kernel>(inputs, q.sums);
    q.action = kernel::index_of_greatest(q.sums);
    return q;
  }
}

}  // namespace striker::policy::avx2

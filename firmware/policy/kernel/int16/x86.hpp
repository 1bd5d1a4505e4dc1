// The kernels for x86-64: SSE2, which every such processor has, and AVX2 where it is compiled for.
//
// The multiply-add is assembly, as GCC 12 folds no load into PMADDWD and re-associates the additions until it
// has to spill. PMADDWD multiplies pairs of half-words and adds each two products. In hidden layers a lane is
// a row, and the activations are broadcast pair by pair: no sum ever has to be gathered across lanes. The few
// rows of the output layer go the other way: a lane is a column, and four rows' sums are gathered at the end.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/kernel/packing.hpp"
#include "firmware/policy/kernel/scaling.hpp"

namespace striker::policy::kernel {

namespace x86 {

struct Sse2Vectors {
  static constexpr const char* name = "sse2";
  using Words [[gnu::vector_size(16)]] = int;
  using Halves [[gnu::vector_size(16)]] = short;

  // In each lane, the products of two pairs of half-words; and added to a sum.
  static Words multiply(Words a, const Words& b) {
    return reinterpret_cast<Words>(
        __builtin_ia32_pmaddwd128(reinterpret_cast<Halves>(a), reinterpret_cast<Halves>(b)));
  }
  static void multiply_add(Words& sum, Words a, const Words& b) { sum += multiply(a, b); }
  // Two vectors of sums become one of half-words, saturated. The row, of both vectors', that a lane has to
  // hold for them to come out in order:
  static Halves narrow(Words low, Words high) { return __builtin_ia32_packssdw128(low, high); }
  static constexpr std::size_t row_of(std::size_t lane) { return lane; }
  using Quad = Words;
  static Quad fold(Words v) { return v; }
};

#ifdef __AVX2__
struct Avx2Vectors {
  static constexpr const char* name = "avx2";
  using Words [[gnu::vector_size(32)]] = int;
  using Halves [[gnu::vector_size(32)]] = short;

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
  // The instruction works within 128-bit halves.
  static Halves narrow(Words low, Words high) { return __builtin_ia32_packssdw256(low, high); }
  static constexpr std::size_t row_of(std::size_t lane) { return lane % 4 + lane / 4 % 2 * 8 + lane / 8 * 4; }
  using Quad [[gnu::vector_size(16)]] = int;
  static Quad fold(Words v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  }
};
#endif

// Numbers in memory as a vector. (The plain name of memcpy would be a call in freestanding code.)
template <class Words, class Number>
[[gnu::always_inline]] inline const Words& vector_at(const Number* numbers) {
  using Aliasing [[gnu::may_alias]] = Words;
  return *reinterpret_cast<const Aliasing*>(numbers);
}

template <class Vectors>
struct Kernel {
  using Words = typename Vectors::Words;
  using Halves = typename Vectors::Halves;
  using Quad = typename Vectors::Quad;
  static constexpr const char* name = Vectors::name;
  static constexpr std::size_t lanes = sizeof(Words) / sizeof(int);
  // Whose sums stay in registers. Of a short layer fewer: the next one begins with the first that are done.
  static constexpr std::size_t chunk_rows(std::size_t inputs) { return (pairs(inputs) <= 4 ? 2 : 8) * lanes; }

  static constexpr std::size_t pairs(std::size_t inputs) { return (inputs + 1) / 2; }
  static constexpr std::size_t rows(std::size_t outputs) { return round_up(outputs, 2 * lanes); }
  static constexpr std::size_t columns(std::size_t inputs) { return round_up(inputs, 2 * lanes); }

  // Past `Count`, zeros.
  template <std::size_t Count>
  struct Activations {
    alignas(Words) std::array<std::int16_t, columns(Count)> values;
    Activations() { std::fill(values.begin() + Count, values.end(), std::int16_t{0}); }
    void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  // Chunk by chunk of rows: for one pair of columns after another, the rows' pairs of weights.
  template <std::size_t Inputs, std::size_t Outputs>
  struct HiddenLayer {
    alignas(Words) std::array<std::int16_t, rows(Outputs) * 2 * pairs(Inputs)> weights{};
    alignas(Words) std::array<std::int32_t, rows(Outputs)> biases{};
  };

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr HiddenLayer<Inputs, Outputs> pack_hidden(const Layer<Inputs, Outputs>& layer) {
    constexpr std::size_t chunk = chunk_rows(Inputs);
    HiddenLayer<Inputs, Outputs> packed;
    const auto biases = rounded_biases(layer);
    for (std::size_t place = 0; place < rows(Outputs); ++place) {
      packed.biases[place] = row_at(place) < Outputs ? biases[row_at(place)] : 0;
    }
    std::size_t at = 0;
    for (std::size_t first = 0; first < rows(Outputs); first += chunk) {
      for (std::size_t pair = 0; pair < pairs(Inputs); ++pair) {
        for (std::size_t place = first; place < std::min(first + chunk, rows(Outputs)); ++place) {
          const std::size_t row = row_at(place);
          for (std::size_t i = 2 * pair; i < 2 * pair + 2; ++i) {
            packed.weights[at++] = static_cast<std::int16_t>(weight_or_zero(layer, row, i));
          }
        }
      }
    }
    return packed;
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const HiddenLayer<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    if constexpr (pairs(Inputs) > lanes) {
      finish_stores(in);  // or the compiler takes stored vectors apart, where a broadcasting load is to be
    }
    constexpr std::size_t chunk = chunk_rows(Inputs);
    constexpr std::size_t whole = rows(Outputs) / chunk * chunk;
    for (std::size_t first = 0; first < whole; first += chunk) {
      hidden_chunk<shift, chunk, pairs(Inputs)>(layer.weights.data() + first * 2 * pairs(Inputs),
                                                layer.biases.data() + first, in.values.data(),
                                                out.values.data() + first);
    }
    if constexpr (constexpr std::size_t rest = rows(Outputs) - whole; rest != 0) {
      hidden_chunk<shift, rest, pairs(Inputs)>(layer.weights.data() + whole * 2 * pairs(Inputs),
                                               layer.biases.data() + whole, in.values.data(),
                                               out.values.data() + whole);
    }
  }

  // Row by row.
  template <std::size_t Inputs, std::size_t Outputs>
  struct OutputLayer {
    alignas(Words) std::array<std::array<std::int16_t, columns(Inputs)>, Outputs> weights{};
    alignas(Quad) std::array<std::int32_t, round_up(Outputs, 4)> biases{};
  };

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr OutputLayer<Inputs, Outputs> pack_output(const Layer<Inputs, Outputs>& layer) {
    OutputLayer<Inputs, Outputs> packed;
    std::copy(layer.biases.begin(), layer.biases.end(), packed.biases.begin());
    for (std::size_t row = 0; row < Outputs; ++row) {
      std::copy(layer.weights[row].begin(), layer.weights[row].end(), packed.weights[row].begin());
    }
    return packed;
  }

  template <std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void sums(const OutputLayer<Inputs, Outputs>& layer,
                                          const Activations<Inputs>& in,
                                          std::array<std::int32_t, Outputs>& out) {
    for (std::size_t first = 0; first < Outputs; first += 4) {
      const std::size_t count = std::min(std::size_t{4}, Outputs - first);
      std::array<Quad, 4> rows{};
      for (std::size_t r = 0; r < count; ++r) {
        rows[r] = Vectors::fold(row_products(layer.weights[first + r], in.values));
      }
      alignas(Quad) std::array<std::int32_t, 4> four;
      const Quad sums = gather(rows) + vector_at<Quad>(layer.biases.data() + first);
      __builtin_memcpy(four.data(), &sums, sizeof sums);
      finish_stores(four);  // loads cost the vector ports nothing, taking lanes does
      std::copy_n(four.begin(), count, out.begin() + first);
    }
  }

 private:
  static constexpr std::size_t row_at(std::size_t place) {
    return place / (2 * lanes) * (2 * lanes) + Vectors::row_of(place % (2 * lanes));
  }

  // A short layer's activations are in a register still, and need not wait for the memory.
  template <std::size_t Pairs>
  [[gnu::always_inline]] static int pair_at(const std::int16_t* activations, std::size_t pair) {
    if constexpr (Pairs <= lanes) {
      return vector_at<Words>(activations)[pair];
    }
    int both = 0;
    __builtin_memcpy(&both, activations + 2 * pair, sizeof both);
    return both;
  }

  template <int shift, std::size_t Rows, std::size_t Pairs>
  [[gnu::always_inline]] static void hidden_chunk(const std::int16_t* weights, const std::int32_t* biases,
                                                  const std::int16_t* activations, std::int16_t* to) {
    constexpr std::size_t vectors = Rows / lanes;
    auto sums = [biases]<std::size_t... v>(std::index_sequence<v...>) {
      return std::array<Words, vectors>{vector_at<Words>(biases + v * lanes)...};
    }
    (std::make_index_sequence<vectors>{});
#pragma GCC unroll 32
    for (std::size_t pair = 0; pair < Pairs; ++pair) {
      const Words both = Words{} + pair_at<Pairs>(activations, pair);
#pragma GCC unroll 8
      for (std::size_t v = 0; v < vectors; ++v) {
        Vectors::multiply_add(sums[v], both, vector_at<Words>(weights + 2 * (pair * Rows + v * lanes)));
      }
    }
#pragma GCC unroll 8
    for (std::size_t v = 0; v < vectors; v += 2) {
      const Halves stored = Vectors::narrow(sums[v] >> shift, sums[v + 1] >> shift);
      const Halves positive = stored > 0 ? stored : Halves{};
      __builtin_memcpy(to + v * lanes, &positive, sizeof positive);
    }
  }

  template <std::size_t Columns>
  [[gnu::always_inline]] static Words row_products(const std::array<std::int16_t, Columns>& weights,
                                                   const std::array<std::int16_t, Columns>& activations) {
    Words sum = Vectors::multiply(vector_at<Words>(activations.data()), vector_at<Words>(weights.data()));
#pragma GCC unroll 16
    for (std::size_t i = 2 * lanes; i < Columns; i += 2 * lanes) {
      Vectors::multiply_add(sum, vector_at<Words>(activations.data() + i),
                            vector_at<Words>(weights.data() + i));
    }
    return sum;
  }

  // Each row's four lanes, added up: a transposition whose steps are additions.
  [[gnu::always_inline]] static Quad gather(const std::array<Quad, 4>& rows) {
    const auto halve = [](Quad a, Quad b) {
      return __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    };
    const Quad low = halve(rows[0], rows[1]);
    const Quad high = halve(rows[2], rows[3]);
    return __builtin_shufflevector(low, high, 0, 1, 4, 5) + __builtin_shufflevector(low, high, 2, 3, 6, 7);
  }
};

#ifdef __AVX2__
// Eight inputs scaled at a time: as scale_input() does, one half of the lanes after the other. A scale's
// shift must not be beyond 32: the result is what lies above it in the 64-bit product, whose lower word is
// all that is taken.
template <std::size_t Inputs>
struct InputScaler {
  static constexpr std::size_t lanes = 8;
  using Words = Avx2Vectors::Words;
  using Wide [[gnu::vector_size(32)]] = long long;
  using UnsignedWide [[gnu::vector_size(32)]] = unsigned long long;

  static constexpr std::size_t padded = round_up(Inputs, lanes);
  alignas(32) std::array<std::int32_t, padded> there{};  // all ones where there is an input
  alignas(32) std::array<std::int32_t, padded> least{}, greatest{}, multiplier{};
  alignas(32) std::array<std::int64_t, padded / 2> even_half{}, odd_half{}, even_shift{}, odd_shift{};

  constexpr explicit InputScaler(const std::array<InputScale, Inputs>& scales) {
    for (std::size_t i = 0; i < Inputs; ++i) {
      const int bits = relevant_bits(scales[i]);
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
    using Halves = Avx2Vectors::Halves;
#pragma GCC unroll 2
    for (std::size_t i = 0; i < padded; i += 2 * lanes) {
      const Words low = scaled(raw, i);
      const Words high = i + lanes < padded ? scaled(raw, i + lanes) : Words{};
      // The packing instruction works within 128-bit halves.
      const auto packed = reinterpret_cast<Wide>(Avx2Vectors::narrow(low, high));
      const auto halves = reinterpret_cast<Halves>(__builtin_shufflevector(packed, packed, 0, 2, 1, 3));
      Halves limit = Halves{} - static_cast<short>(greatest_activation);
      asm("" : "+x"(limit));  // of a constant that it knows, GCC 12 makes a comparison and a blend
      const Halves stored = halves > limit ? halves : limit;
      __builtin_memcpy(to + i, &stored, sizeof stored);
    }
  }

 private:
  // Eight of them, still in words.
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
#endif

}  // namespace x86

using Sse2 = x86::Kernel<x86::Sse2Vectors>;
#ifdef __AVX2__
struct Avx2 : x86::Kernel<x86::Avx2Vectors> {
  template <const auto& policy, std::size_t Inputs>
  [[gnu::always_inline]] static void scale(
      const std::array<std::int32_t, Inputs>& raw,
      Activations<Inputs>& in) requires(x86::InputScaler<Inputs>::can_scale(policy.input_scales)) {
    static constexpr x86::InputScaler<Inputs> scaler(policy.input_scales);
    scaler.scale(raw, in.values.data());
  }
};
#endif

}  // namespace striker::policy::kernel

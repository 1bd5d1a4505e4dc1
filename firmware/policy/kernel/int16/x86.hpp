// SPDX-License-Identifier: Apache-2.0
// The kernel for int16 weights and x86-64: SSE2, which every such processor has.
//
// PMADDWD multiplies pairs of half-words and adds each two products. In hidden layers a lane is a row, and
// the activations are broadcast pair by pair: no sum ever has to be gathered across lanes. The few rows of
// the output layer go the other way: a lane is a column, and four rows' sums are gathered at the end. So the
// two roles of a layer are packed differently.
//
// Of 4 rows and one pair of columns, 8 products, GCC makes of hidden_chunk() 4 instructions, the first of
// which serves all rows of the chunk:
//
//   pshufd  xmm2, xmm0, 0                            the pair of activations in all lanes
//   movdqa  xmm1, xmm2
//   pmaddwd xmm1, [rax]                              times (w01 w00), (w11 w10), (w21 w20), (w31 w30)
//   paddd   xmm3, xmm1                               to the four rows' sums
//
// where wRC is row R's weight of column C.
//
// The kernel is a template over the vectors: tests/policy/avx2_kernel.hpp makes one of 256 bits of it, which
// no program of the firmware is compiled for.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/kernel/activations.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"

namespace striker::policy::kernel::int16 {

namespace x86 {

// What Kernel<Vectors> needs to know of vectors of 128 bits: words for sums, half-words for activations and
// weights, and quads of words for the output layer.
struct Sse2Vectors {
  static constexpr const char* name = "int16/sse2";
  using Words [[gnu::vector_size(16)]] = int;
  using Halves [[gnu::vector_size(16)]] = short;
  using Quad = Words;

  // In each lane, the sum of the products of two pairs of half-words.
  static Words multiply(Words a, const Words& b) {
    return reinterpret_cast<Words>(
        __builtin_ia32_pmaddwd128(reinterpret_cast<Halves>(a), reinterpret_cast<Halves>(b)));
  }
  static void multiply_add(Words& sum, Words a, const Words& b) { sum += multiply(a, b); }
  // Two vectors of words as one of half-words, saturated.
  static Halves narrow(Words low, Words high) { return __builtin_ia32_packssdw128(low, high); }
  // Which row a lane of the two vectors has to hold, for narrow() to put all rows in order.
  static constexpr std::size_t row_of(std::size_t lane) { return lane; }
  // A vector's sum in four lanes.
  static Quad fold(Words v) { return v; }
};

// Numbers in memory as a vector. (Where one is copied instead, it is by __builtin_memcpy: in freestanding
// code the plain name would be a call.)
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
  static constexpr bool rounds = false;
  static constexpr std::size_t lanes = sizeof(Words) / sizeof(int);
  // A chunk is the rows whose sums stay in registers: as many as there is room for. In a layer of few inputs
  // it is a quarter of that, as the next layer can begin with the first rows that are done.
  static constexpr std::size_t chunk_rows(std::size_t inputs) { return (pairs(inputs) <= 4 ? 2 : 8) * lanes; }

  static constexpr std::size_t pairs(std::size_t inputs) { return (inputs + 1) / 2; }
  static constexpr std::size_t rows(std::size_t outputs) { return round_up(outputs, 2 * lanes); }
  static constexpr std::size_t columns(std::size_t inputs) { return round_up(inputs, 2 * lanes); }

  // What lies past `Count` is zero.
  template <std::size_t Count>
  struct Activations {
    alignas(Words) std::array<std::int16_t, columns(Count)> values;
    Activations() { std::fill(values.begin() + Count, values.end(), std::int16_t{0}); }
    void set(std::size_t i, std::int32_t value) { values[i] = static_cast<std::int16_t>(value); }
  };

  // A hidden layer as it is packed, one chunk of rows after another: for each pair of columns, its rows'
  // pairs of weights. The rows are filled up to whole pairs of vectors.
  template <std::size_t Inputs, std::size_t Outputs>
  struct HiddenLayer {
    alignas(Words) std::array<std::int16_t, rows(Outputs) * 2 * pairs(Inputs)> weights{};
    alignas(Words) std::array<std::int32_t, rows(Outputs)> biases{};
  };

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr HiddenLayer<Inputs, Outputs> pack_hidden(const Layer<Inputs, Outputs>& layer,
                                                            const std::array<std::int32_t, Outputs>& biases) {
    constexpr std::size_t chunk = chunk_rows(Inputs);
    HiddenLayer<Inputs, Outputs> packed;
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

  // The output layer as it is packed: row by row.
  template <std::size_t Inputs, std::size_t Outputs>
  struct OutputLayer {
    alignas(Words) std::array<std::array<std::int16_t, columns(Inputs)>, Outputs> weights{};
    alignas(Quad) std::array<std::int32_t, round_up(Outputs, 4)> biases{};
  };

  template <std::size_t Inputs, std::size_t Outputs>
  static constexpr OutputLayer<Inputs, Outputs> pack_output(const Layer<Inputs, Outputs>& layer,
                                                            const std::array<std::int32_t, Outputs>& biases) {
    OutputLayer<Inputs, Outputs> packed;
    std::copy(biases.begin(), biases.end(), packed.biases.begin());
    for (std::size_t row = 0; row < Outputs; ++row) {
      std::copy(layer.weights[row].begin(), layer.weights[row].end(), packed.weights[row].begin());
    }
    return packed;
  }

  template <Role role, std::size_t Inputs, std::size_t Outputs>
  static constexpr auto pack(const Layer<Inputs, Outputs>& layer,
                             const std::array<std::int32_t, Outputs>& biases) {
    if constexpr (role == Role::hidden) {
      return pack_hidden(layer, biases);
    } else {
      return pack_output(layer, biases);
    }
  }

  template <int shift, std::size_t Inputs, std::size_t Outputs>
  [[gnu::always_inline]] static void hidden(const HiddenLayer<Inputs, Outputs>& layer,
                                            const Activations<Inputs>& in, Activations<Outputs>& out) {
    if constexpr (pairs(Inputs) > lanes) {
      finish_stores(in);  // else the compiler takes stored vectors apart, instead of a broadcasting load
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
  // Which row is at a place of the packed layer.
  static constexpr std::size_t row_at(std::size_t place) {
    return place / (2 * lanes) * (2 * lanes) + Vectors::row_of(place % (2 * lanes));
  }

  // A pair of activations as a word. Those of a layer of few inputs are in a register still, from where they
  // need not wait for the memory.
  template <std::size_t Pairs>
  [[gnu::always_inline]] static int pair_at(const std::int16_t* activations, std::size_t pair) {
    if constexpr (Pairs <= lanes) {
      return vector_at<Words>(activations)[pair];
    }
    int both = 0;
    __builtin_memcpy(&both, activations + 2 * pair, sizeof both);
    return both;
  }

  // Computes and stores the activations of a chunk's rows.
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

  // The sum of a row's products, still in the lanes.
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

  // Each row's four lanes added up, row by row in a lane: a transposition whose steps are additions.
  [[gnu::always_inline]] static Quad gather(const std::array<Quad, 4>& rows) {
    const auto halve = [](Quad a, Quad b) {
      return __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    };
    const Quad low = halve(rows[0], rows[1]);
    const Quad high = halve(rows[2], rows[3]);
    return __builtin_shufflevector(low, high, 0, 1, 4, 5) + __builtin_shufflevector(low, high, 2, 3, 6, 7);
  }
};

}  // namespace x86

using Sse2 = x86::Kernel<x86::Sse2Vectors>;

}  // namespace striker::policy::kernel::int16

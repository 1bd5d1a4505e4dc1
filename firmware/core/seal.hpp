// SPDX-License-Identifier: Apache-2.0
// A checksum over state, so that memory which changes by itself is noticed before it is used.
//
// The owner seals its state when it has written it, and compares before it uses it the next time. A sum of
// words finds every error within one word, a flipped bit among them. Types with padding are refused by the
// compiler: what a padding byte holds is nobody's promise.
//
// Cost: a load and an addition a word; unrolled where there are more than `few_words`.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace striker::core {

inline constexpr std::size_t few_words = 32;  // unrolled they would take more flash than time

// Apart from its callers: unrolled, it is long.
template <class State>
[[nodiscard, gnu::noinline]] constexpr std::uint32_t seal_of(const State& state) {
  static_assert(std::is_trivially_copyable_v<State> && std::has_unique_object_representations_v<State>,
                "sealed state has no padding");
  static_assert(sizeof(State) % sizeof(std::uint32_t) == 0);
  constexpr std::size_t words = sizeof(State) / sizeof(std::uint32_t);
  std::uint32_t sum = 0x5EA1ED00;      // all zero is not a valid state
  if (std::is_constant_evaluated()) {  // GCOVR_EXCL_START: the compiler alone runs this
    for (const std::uint32_t word : std::bit_cast<std::array<std::uint32_t, words>>(state)) {
      sum += word;
    }
    return sum;
  }  // GCOVR_EXCL_STOP
  const auto* bytes = reinterpret_cast<const unsigned char*>(&state);
  const auto add = [&](std::size_t i) {
    std::uint32_t word = 0;
    __builtin_memcpy(&word, __builtin_assume_aligned(bytes + sizeof word * i, sizeof word), sizeof word);
    sum += word;
  };
  if constexpr (words <= few_words) {
#pragma GCC unroll 1
    for (std::size_t i = 0; i < words; ++i) {
      add(i);
    }
  } else {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < words; ++i) {
      add(i);
    }
  }
  return sum;
}

// A state beside its seal.
template <class State>
struct Sealed {
  State state{};
  std::uint32_t seal = seal_of(state);

  [[nodiscard]] bool is_sound() const { return seal_of(state) == seal; }
  void close() { seal = seal_of(state); }
};

}  // namespace striker::core

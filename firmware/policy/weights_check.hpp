// SPDX-License-Identifier: Apache-2.0
// Whether the weights in the image are still those that were exported, checked a slice a tick, for ever.
//
// The compiler hashes the packed weights, which are what the kernel reads (FNV-1a over 32-bit words: each step is a
// bijection of the hash, so that a change within one word always changes the result). At run time the same hash goes
// over the memory, `words_a_tick` words at a time; a whole pass takes at most `pass_ticks`. What changes just after it
// was read is found by the next pass: within two of them, a second.
//
//   WeightsCheck<policy::kick> check;
//   if (!check.step()) ...    // once a tick: false for ever after a pass that came out different
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/policy/network.hpp"

namespace striker::policy {

namespace detail {

inline constexpr std::uint32_t fnv_begin = 2166136261U;
constexpr std::uint32_t fnv_next(std::uint32_t hash, std::uint32_t word) {
  return (hash ^ word) * 16777619U;
}

// A function for the same reason as bytes_of().
template <class Layer>
constexpr std::uint32_t words_of(const Layer& /*layer*/) {
  static_assert(sizeof(Layer) % sizeof(std::uint32_t) == 0, "packed weights are whole words");
  return sizeof(Layer) / sizeof(std::uint32_t);
}

template <class Layer>
constexpr std::uint32_t fnv_of(std::uint32_t hash, const Layer& layer) {
  using Words = std::array<std::uint32_t, sizeof(Layer) / sizeof(std::uint32_t)>;
  for (const std::uint32_t word : std::bit_cast<Words>(layer)) {
    hash = fnv_next(hash, word);
  }
  return hash;
}

}  // namespace detail

template <const auto& policy>
class WeightsCheck {
  using Weights = Packed<policy>;

 public:
  static constexpr std::size_t words = Weights::bytes / sizeof(std::uint32_t);
  static constexpr std::size_t pass_ticks = 500;
  // Each layer ends in a slice of its own.
  static constexpr std::uint32_t words_a_tick =
      (words + pass_ticks - Weights::layers - 1) / (pass_ticks - Weights::layers);
  static constexpr std::uint32_t expected = []<std::size_t... n>(std::index_sequence<n...>) {
    std::uint32_t hash = detail::fnv_begin;
    ((hash = detail::fnv_of(hash, Weights::template layer<n>)), ...);
    return hash;
  }
  (std::make_index_sequence<Weights::layers>{});

  // Cost: a load, an exclusive or and a multiplication a word.
  [[nodiscard]] bool step() {
    const std::uint32_t rest = layer_words[layer_] - at_;
    const std::uint32_t slice = rest < words_a_tick ? rest : words_a_tick;
    const auto* bytes = layer_at(layer_) + sizeof(std::uint32_t) * at_;
    for (std::uint32_t i = 0; i < slice; ++i) {
      std::uint32_t word = 0;
      __builtin_memcpy(&word, __builtin_assume_aligned(bytes, sizeof word), sizeof word);
      hash_ = detail::fnv_next(hash_, word);
      bytes += sizeof word;
    }
    at_ += slice;
    if (slice == rest) {
      end_layer();
    }
    return altered_ == 0;
  }

 private:
  static constexpr auto layer_words = []<std::size_t... n>(std::index_sequence<n...>) {
    return std::array<std::uint32_t, Weights::layers>{detail::words_of(Weights::template layer<n>)...};
  }
  (std::make_index_sequence<Weights::layers>{});

  template <std::size_t n = 0>
  static const unsigned char* layer_at(std::uint32_t layer) {
    if constexpr (n + 1 < Weights::layers) {
      if (layer != n) {
        return layer_at<n + 1>(layer);
      }
    }
    const void* const begin = &Weights::template layer<n>;
    return static_cast<const unsigned char*>(begin);
  }
  void end_layer() {
    at_ = 0;
    if (++layer_ == Weights::layers) {
      altered_ = altered_ != 0 || hash_ != expected ? 1 : 0;
      layer_ = 0;
      hash_ = detail::fnv_begin;
    }
  }

  // Whole words, as the state is sealed.
  std::uint32_t hash_ = detail::fnv_begin;
  std::uint32_t layer_ = 0;
  std::uint32_t at_ = 0;
  std::uint32_t altered_ = 0;
};

}  // namespace striker::policy

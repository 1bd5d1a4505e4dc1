// What every kernel shares: input scaling, ReLU with saturation, and argmax, on one number at a time.
//
// No branch depends on a value: the answers come from masks, on every target in the same number of
// instructions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/policy/policy.hpp"

namespace striker::policy::kernel {

inline constexpr std::int32_t greatest_activation = 32767;

// All ones if a < b, else 0.
constexpr std::int32_t less_mask(std::int64_t a, std::int64_t b) {
  return static_cast<std::int32_t>((a - b) >> 63);
}

constexpr std::int32_t select(std::int32_t mask, std::int32_t if_set, std::int32_t otherwise) {
  return otherwise ^ ((if_set ^ otherwise) & mask);
}

// The lesser of a value and a limit, and the greater: where their difference fits 32 bits.
constexpr std::int32_t at_most(std::int32_t limit, std::int32_t value) {
  const std::int32_t room = limit - value;
  return value + (room & (room >> 31));
}
constexpr std::int32_t at_least(std::int32_t limit, std::int32_t value) {
  const std::int32_t above = value - limit;
  return value - (above & (above >> 31));
}

// min(value, 32767) for value >= 0, and 0 below: ReLU and saturation in one.
constexpr std::int32_t saturate_relu(std::int32_t value) {
  return at_most(greatest_activation, value & ~(value >> 31));
}

// To [-2^bits, 2^bits - 1], for bits < 31.
template <int bits>
constexpr std::int32_t saturate_to(std::int32_t value) {
#ifdef __ARM_FEATURE_SAT
  if (!std::is_constant_evaluated()) {
    std::int32_t saturated;
    asm("ssat %0, %1, %2" : "=r"(saturated) : "i"(bits + 1), "r"(value));
    return saturated;
  }
#endif
  const std::int32_t sign = value >> 31;
  const std::int32_t excess = (value >> bits) ^ sign;
  return select(-excess >> 31, sign ^ ((std::int32_t{1} << bits) - 1), value);
}

// The fewest bits that a raw input may be saturated to without changing its activation; 31 is all of them.
// Saturated, the scaled input fits 32 bits, and one 64-bit product is all that is wide.
constexpr int relevant_bits(const InputScale& scale) {
  int bits = 0;
  while (bits < 31 && ((std::int64_t{1} << bits) - 1) * scale.multiplier <
                          (std::int64_t{greatest_activation} + 1) << scale.shift) {
    ++bits;
  }
  return bits;
}

#ifdef __ARM_FEATURE_DSP
// SMMULR keeps the upper word of a product, rounded: a scale's shift is made to be 32, by the multiplier as
// far as it has room, and by the saturated raw input for the rest.
struct WordScale {
  std::int32_t multiplier = 0;
  int raw_shift = 0;
  bool exact = false;
};

constexpr WordScale word_scale(const InputScale& scale) {
  WordScale word{scale.multiplier, 32 - scale.shift, false};
  while (word.raw_shift > 0 && word.multiplier < 1 << 30) {
    word.multiplier *= 2;
    --word.raw_shift;
  }
  word.exact = word.raw_shift >= 0 && relevant_bits(scale) + word.raw_shift <= 31;
  return word;
}

template <InputScale scale>
inline std::int32_t scale_word(std::int32_t saturated) {
  constexpr WordScale word = word_scale(scale);
  std::int32_t scaled;
  asm("smmulr %0, %1, %2" : "=r"(scaled) : "r"(saturated * (1 << word.raw_shift)), "r"(word.multiplier));
  asm("ssat %0, #16, %1" : "=r"(scaled) : "r"(scaled));
  return at_least(-greatest_activation, scaled);
}
#endif

// Without a 64-bit product: the raw input in two parts, raw = upper * 2^bits + lower, each of whose products
// fits 32 bits. As 2^bits divides the shift's power, the lower product's last bits never matter.
constexpr int split_bits(const InputScale& scale) {
  return scale.shift > 16 ? scale.shift - 15 : 1;
}

constexpr bool splits(const InputScale& scale) {
  const int bits = split_bits(scale);
  const std::int64_t lower =
      ((std::int64_t{1} << bits) - 1) * scale.multiplier + (std::int64_t{1} << (scale.shift - 1));
  const std::int64_t whole = (std::int64_t{1} << relevant_bits(scale)) * scale.multiplier + lower;
  return relevant_bits(scale) < 31 && scale.shift >= bits && lower < std::int64_t{1} << 32 &&
         whole >> bits < std::int64_t{1} << 31;
}

template <InputScale scale>
constexpr std::int32_t scale_split(std::int32_t saturated) {
  constexpr int bits = split_bits(scale);
  constexpr std::uint32_t half = 1U << (scale.shift - 1);
  const auto lower = static_cast<std::uint32_t>(saturated) & ((1U << bits) - 1);
  const std::uint32_t carried = (lower * static_cast<std::uint32_t>(scale.multiplier) + half) >> bits;
  const std::int32_t product = (saturated >> bits) * scale.multiplier + static_cast<std::int32_t>(carried);
  return product >> (scale.shift - bits);
}

template <InputScale scale>
constexpr std::int32_t scale_input(std::int32_t raw) {
  constexpr int bits = relevant_bits(scale);
  constexpr std::int64_t half = std::int64_t{1} << (scale.shift - 1);
#ifdef __x86_64__
  const std::int64_t wide = (std::int64_t{raw} * scale.multiplier + half) >> scale.shift;
  return static_cast<std::int32_t>(
      std::clamp<std::int64_t>(wide, -greatest_activation, greatest_activation));  // conditional moves
#endif
  if constexpr (bits < 31) {
    raw = saturate_to<bits>(raw);
  }
#ifdef __ARM_FEATURE_DSP
  if constexpr (word_scale(scale).exact) {
    if (!std::is_constant_evaluated()) {
      return scale_word<scale>(raw);
    }
  }
#endif
#if defined(__arm__) && __ARM_ARCH == 6
  if constexpr (splits(scale)) {
    return at_least(-greatest_activation, at_most(greatest_activation, scale_split<scale>(raw)));
  }
#endif
  const auto scaled = static_cast<std::int32_t>((std::int64_t{raw} * scale.multiplier + half) >> scale.shift);
  return at_least(-greatest_activation, at_most(greatest_activation, scaled));
}

// The index of the greatest; of equals, the lowest.
template <std::size_t Actions>
constexpr std::uint8_t index_of_greatest(const std::array<std::int32_t, Actions>& sums) {
  std::int32_t best = sums[0];
  std::int32_t index = 0;
  for (std::size_t k = 1; k < Actions; ++k) {
    const std::int32_t greater = less_mask(best, sums[k]);
    best = select(greater, sums[k], best);
    index = select(greater, static_cast<std::int32_t>(k), index);
  }
  return static_cast<std::uint8_t>(index);
}

// The rounding that a hidden layer adds before its shift belongs to the bias: one addition fewer a neuron.
// The proof bounds bias and rounding together.
template <std::size_t Inputs, std::size_t Outputs, class Weight>
constexpr std::array<std::int32_t, Outputs> rounded_biases(const Layer<Inputs, Outputs, Weight>& layer) {
  auto biases = layer.biases;
  for (std::int32_t& bias : biases) {
    bias += std::int32_t{1} << (layer.shift - 1);
  }
  return biases;
}

}  // namespace striker::policy::kernel

// SPDX-License-Identifier: Apache-2.0
// Input scaling: from a raw integer in its own unit to an activation, as firmware/policy/policy.hpp has it:
//
//   a = clamp((raw * multiplier + 2^(shift - 1)) >> shift, -32767, 32767)
//
// A scale is a constant of the policy, so the compiler picks the shortest way to these bits that the scale
// and the processor allow. None has a branch on the value, and none but the first on x86-64 a wider product
// than the processor is quick at.
//
// Example: a speed in mm/s with multiplier 842150 and shift 18 (2550 mm/s becomes 8192). Beyond 10200 mm/s
// the activation is at its limit, so the raw input is saturated to 14 bits first, to [-16384, 16383]:
//
//   with SMMULR (Armv7E-M, Armv8-M)  upper word of (raw * 2^3) * (842150 * 2^11), rounded; SSAT to 16 bits
//   in 32 bits (Armv6-M)             raw = 2^3 * upper + lower, a product each, the lower one's carry added
//   else                             the formula, with one 64-bit product
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "firmware/policy/kernel/branch_free.hpp"
#include "firmware/policy/policy.hpp"

namespace striker::policy::kernel {

// The fewest bits that a raw input may be saturated to without changing its activation; 31 is all of them.
// A saturated input's activation fits 32 bits before it is clamped, so that only the product is wide.
constexpr int relevant_bits(const InputScale& scale) {
  int bits = 0;
  while (bits < 31 && ((std::int64_t{1} << bits) - 1) * scale.multiplier <
                          (std::int64_t{greatest_activation} + 1) << scale.shift) {
    ++bits;
  }
  return bits;
}

#ifdef __ARM_FEATURE_DSP
// A scale for SMMULR, which keeps the upper word of a product, rounded: its shift is 32. The multiplier takes
// up the powers of two that are missing as far as it has room, and the saturated raw input the rest.
struct WordScale {
  std::int32_t multiplier = 0;
  int raw_shift = 0;
  bool exact = false;  // the shifted raw input fits 32 bits
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

// Where a raw input is split into raw = upper * 2^bits + lower, so that the products of both fit 32 bits. As
// 2^bits divides the shift's power, the bits that the lower product loses never matter.
constexpr int split_bits(const InputScale& scale) {
  return scale.shift > 16 ? scale.shift - 15 : 1;
}

// Whether a scale's split products really fit 32 bits.
constexpr bool splits(const InputScale& scale) {
  const int bits = split_bits(scale);
  const std::int64_t lower =
      ((std::int64_t{1} << bits) - 1) * scale.multiplier + (std::int64_t{1} << (scale.shift - 1));
  const std::int64_t whole = (std::int64_t{1} << relevant_bits(scale)) * scale.multiplier + lower;
  return relevant_bits(scale) < 31 && scale.shift >= bits && lower < std::int64_t{1} << 32 &&
         whole >> bits < std::int64_t{1} << 31;
}

// The scaled input before it is clamped, without a 64-bit product, for a scale that splits().
template <InputScale scale>
constexpr std::int32_t scale_split(std::int32_t saturated) {
  constexpr int bits = split_bits(scale);
  constexpr std::uint32_t half = 1U << (scale.shift - 1);
  const auto lower = static_cast<std::uint32_t>(saturated) & ((1U << bits) - 1);
  const std::uint32_t carried = (lower * static_cast<std::uint32_t>(scale.multiplier) + half) >> bits;
  const std::int32_t product = (saturated >> bits) * scale.multiplier + static_cast<std::int32_t>(carried);
  return product >> (scale.shift - bits);
}

// A raw input's activation, for any raw value.
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

}  // namespace striker::policy::kernel

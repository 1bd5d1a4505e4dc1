// SPDX-License-Identifier: Apache-2.0
// Comparison, choice and saturation of integers without a branch.
//
// The answers are made of masks (an arithmetic shift spreads a sign over the whole word), or of a saturating
// instruction where the processor has one. So every value takes the same instructions, on every target.
#pragma once

#include <cstdint>
#include <type_traits>

namespace striker::policy::kernel {

inline constexpr std::int32_t greatest_activation = 32767;

// All ones if a < b, else 0.
constexpr std::int32_t less_mask(std::int64_t a, std::int64_t b) {
  return static_cast<std::int32_t>((a - b) >> 63);
}

// One of two values, by a mask of all ones or 0.
constexpr std::int32_t choose(std::int32_t mask, std::int32_t if_set, std::int32_t otherwise) {
  return otherwise ^ ((if_set ^ otherwise) & mask);
}

// The lesser of a value and a limit whose difference fits 32 bits.
constexpr std::int32_t at_most(std::int32_t limit, std::int32_t value) {
  const std::int32_t room = limit - value;
  return value + (room & (room >> 31));
}

// The greater of a value and a limit whose difference fits 32 bits.
constexpr std::int32_t at_least(std::int32_t limit, std::int32_t value) {
  const std::int32_t above = value - limit;
  return value - (above & (above >> 31));
}

// ReLU and saturation in one: min(value, 32767) for value >= 0, and 0 below.
constexpr std::int32_t saturate_relu(std::int32_t value) {
  return at_most(greatest_activation, value & ~(value >> 31));
}

// The nearest value in [-2^bits, 2^bits - 1], for bits < 31: SSAT where there is one.
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
  return choose(-excess >> 31, sign ^ ((std::int32_t{1} << bits) - 1), value);
}

}  // namespace striker::policy::kernel

// SPDX-License-Identifier: Apache-2.0
// Numbers of IEEE 754's binary32 (a C float) as drives of others send and want them, from and to integers: with integers
// alone, as the core has no floating point. Both ways are rounded once, from the exact result.
//
//   scaled_binary32(0x3FC00000, 1000)   // 1.5 * 1000: 1500
//   binary32_of_ratio(3, 2)             // 0x3FC00000
//
// Both are called, not inlined: an image holds them once. Cost: a multiplication of 64 bits and a shift; 24 subtractions of 64 bits and as many shifts more as the ratio is far
// from 1. No division.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace striker::can {

// value * factor to the nearest integer, halves away from zero. Nothing for an infinity, for what is no number (NaN), and
// for a result beyond +-(2^31 - 1). Subnormal numbers and -0 are taken as what they are.
[[nodiscard, gnu::noinline]] constexpr std::optional<std::int32_t> scaled_binary32(std::uint32_t bits,
                                                                                   std::uint32_t factor) {
  constexpr std::uint64_t greatest = std::numeric_limits<std::int32_t>::max();
  const std::uint32_t exponent = bits >> 23U & 0xFFU;
  if (exponent == 0xFF) {
    return std::nullopt;
  }
  const std::uint32_t hidden_bit = exponent != 0 ? 0x80'0000U : 0;
  const std::uint64_t product = std::uint64_t{(bits & 0x7F'FFFFU) | hidden_bit} * factor;  // below 2^56
  // The value is product / 2^(150 - exponent).
  const std::uint32_t raised = exponent != 0 ? exponent : 1;
  std::uint64_t magnitude = 0;
  if (raised >= 150) {
    const std::uint32_t left = raised - 150;
    if (product > (left < 31 ? greatest >> left : 0)) {
      return std::nullopt;
    }
    magnitude = product << (left & 31U);
  } else if (const std::uint32_t right = 150 - raised; right <= 57) {
    magnitude = (product + (std::uint64_t{1} << (right - 1))) >> right;
  }
  if (magnitude > greatest) {
    return std::nullopt;
  }
  const auto value = static_cast<std::int32_t>(magnitude);
  return (bits >> 31U) != 0 ? -value : value;
}

// The binary32 that is nearest to numerator / denominator, halves to even. Denominators from 1 to 2^31; 0 gives +0.
[[nodiscard, gnu::noinline]] constexpr std::uint32_t binary32_of_ratio(std::int32_t numerator,
                                                                       std::uint32_t denominator) {
  if (numerator == 0) {
    return 0;
  }
  const std::uint32_t sign = numerator < 0 ? 0x8000'0000U : 0;
  std::uint64_t rest =
      numerator < 0 ? 0U - static_cast<std::uint32_t>(numerator) : static_cast<std::uint32_t>(numerator);
  std::uint64_t unit = denominator;
  std::int32_t exponent = 127;
  for (; rest >= 2 * unit; ++exponent) {
    unit <<= 1U;
  }
  for (; rest < unit; --exponent) {
    rest <<= 1U;
  }
  std::uint32_t digits = 0;
  for (int i = 0; i < 24; ++i) {
    const bool one = rest >= unit;
    digits = digits << 1U | (one ? 1U : 0U);
    rest = (one ? rest - unit : rest) << 1U;
  }
  digits += rest > unit || (rest == unit && (digits & 1U) != 0) ? 1U : 0U;
  // A carry out of the digits raises the exponent by itself.
  return sign | ((static_cast<std::uint32_t>(exponent) << 23U) + (digits - 0x80'0000U));
}

static_assert(scaled_binary32(0x3FC0'0000, 1000) == 1500 && scaled_binary32(0xBF00'0000, 1) == -1);
static_assert(binary32_of_ratio(3, 2) == 0x3FC0'0000 && binary32_of_ratio(-1, 10) == 0xBDCC'CCCD);

}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// The integer conversions of binary32 against the host's floating point, over all exponents and signs.
#include "firmware/can/drives/binary32.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

namespace striker::can {
namespace {

// The product has at most 24 + 21 bits: a double holds it exactly, and llround rounds halves away from zero.
std::optional<std::int32_t> by_host(std::uint32_t bits, std::uint32_t factor) {
  const double product = static_cast<double>(std::bit_cast<float>(bits)) * factor;
  if (!(std::abs(product) < 2147483647.5)) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(std::llround(product));
}

TEST(Binary32, IsScaledAsTheHostScalesIt) {
  constexpr std::uint32_t step = 397;  // a prime: mantissas of every kind with every exponent
  for (const std::uint32_t factor : {1U, 1000U, 100'000U, 251'327U, 1'256'637U}) {
    std::uint32_t bits = 0;
    for (std::uint64_t at = 0; at <= 0xFFFF'FFFFU; at += step) {
      bits = static_cast<std::uint32_t>(at);
      ASSERT_EQ(scaled_binary32(bits, factor), by_host(bits, factor)) << std::hex << bits;
    }
  }
}

TEST(Binary32, AtEveryEdge) {
  for (std::uint32_t exponent = 0; exponent < 256; ++exponent) {
    for (const std::uint32_t mantissa :
         {0x0U, 0x1U, 0x2U, 0x3F'FFFFU, 0x40'0000U, 0x40'0001U, 0x7F'FFFEU, 0x7F'FFFFU}) {
      for (const std::uint32_t sign : {0U, 1U}) {
        const std::uint32_t bits = sign << 31U | exponent << 23U | mantissa;
        for (const std::uint32_t factor : {0U, 1U, 2U, 3U, 1000U, 251'327U}) {
          ASSERT_EQ(scaled_binary32(bits, factor), by_host(bits, factor))
              << std::hex << bits << " " << factor;
        }
      }
    }
  }
}

TEST(Binary32, WhatIsNoNumberIsNone) {
  for (std::uint32_t mantissa = 0; mantissa < 0x80'0000U; ++mantissa) {
    ASSERT_FALSE(scaled_binary32(0x7F80'0000U | mantissa, 1));
    ASSERT_FALSE(scaled_binary32(0xFF80'0000U | mantissa, 0));
  }
}

// Both are floats exactly up to 2^24, and the host's division is rounded once.
TEST(Binary32, OfARatioIsTheHostsQuotient) {
  for (const std::uint32_t denominator :
       {1U, 3U, 10U, 100U, 1000U, 4999U, 100'000U, 16'777'213U, 16'777'216U}) {
    for (std::int32_t numerator = -200'000; numerator <= 200'000; ++numerator) {
      ASSERT_EQ(binary32_of_ratio(numerator, denominator),
                std::bit_cast<std::uint32_t>(static_cast<float>(numerator) / static_cast<float>(denominator)))
          << numerator << " / " << denominator;
    }
    for (std::int32_t numerator = 16'777'216; numerator > 16'000'000; numerator -= 997) {
      ASSERT_EQ(binary32_of_ratio(numerator, denominator),
                std::bit_cast<std::uint32_t>(static_cast<float>(numerator) / static_cast<float>(denominator)))
          << numerator << " / " << denominator;
    }
  }
}

// Beyond 2^24 every second whole number lies half way between two floats, and beyond 2^25 others do.
TEST(Binary32, HalvesGoToEven) {
  const auto of_host = [](std::int32_t value) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  };
  for (std::int32_t value = 1 << 24; value < (1 << 24) + 100'000; ++value) {
    ASSERT_EQ(binary32_of_ratio(value, 1), of_host(value)) << value;
    ASSERT_EQ(binary32_of_ratio(-value, 1), of_host(-value)) << value;
  }
  for (std::uint32_t value = 1U << 25; value < 0x8000'0000U; value += 4093) {
    ASSERT_EQ(binary32_of_ratio(static_cast<std::int32_t>(value), 1),
              of_host(static_cast<std::int32_t>(value)));
  }
}

// Every torque that a wheel command holds, with every gear.
TEST(Binary32, ATorqueComesBackAsItWent) {
  for (std::uint32_t gear_percent = 10; gear_percent <= 10'000; ++gear_percent) {
    for (std::int32_t torque_mNm = 0; torque_mNm <= 2'000; torque_mNm += gear_percent % 50 == 0 ? 1 : 37) {
      ASSERT_EQ(scaled_binary32(binary32_of_ratio(torque_mNm, 10 * gear_percent), 10 * gear_percent),
                torque_mNm);
      ASSERT_EQ(scaled_binary32(binary32_of_ratio(-torque_mNm, 10 * gear_percent), 10 * gear_percent),
                -torque_mNm);
    }
  }
}

}  // namespace
}  // namespace striker::can

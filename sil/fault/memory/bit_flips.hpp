// SPDX-License-Identifier: Apache-2.0
// Places in memory that may be damaged, and how many bits they have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace striker::sil {

[[nodiscard]] inline std::uint64_t bits_of(std::span<const std::span<std::byte>> parts) {
  std::uint64_t bits = 0;
  for (const auto& part : parts) {
    bits += 8 * part.size();
  }
  return bits;
}

// `bit` is below bits_of(parts).
inline void flip(std::span<const std::span<std::byte>> parts, std::uint64_t bit) {
  auto part = parts.begin();
  for (; bit >= 8 * part->size(); ++part) {
    bit -= 8 * part->size();
  }
  (*part)[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
}

}  // namespace striker::sil

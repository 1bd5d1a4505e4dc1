// SPDX-License-Identifier: Apache-2.0
// Acceptance filters of the mask kind, for drivers of CAN controllers: what the controller listens to
// (accepted_identifiers.hpp) in as few filters as the hardware has. Found by the compiler.
//
//   constexpr auto filters = acceptance_filters<4>(accepted_identifiers);
//
// Each identifier passes one of them at least. Where there are more identifiers than filters, neighbours share
// one: the two whose common filter lets the fewest identifiers through, again and again. What passes although
// nobody asked for it, the receive checks ignore.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace striker::bare_metal {

inline constexpr std::uint16_t every_bit_of_identifier = 0x7FF;

// Passes an identifier that equals `id` in the bits of `mask`.
struct AcceptanceFilter {
  std::uint16_t id = 0;
  std::uint16_t mask = every_bit_of_identifier;

  [[nodiscard]] constexpr bool passes(std::uint16_t identifier) const {
    return ((identifier ^ id) & mask) == 0;
  }
  friend constexpr bool operator==(const AcceptanceFilter&, const AcceptanceFilter&) = default;
};

// The narrowest filter that passes all that either passes.
[[nodiscard]] constexpr AcceptanceFilter merged(const AcceptanceFilter& one, const AcceptanceFilter& other) {
  const int mask = one.mask & other.mask & ~(one.id ^ other.id);
  return {.id = static_cast<std::uint16_t>(one.id & mask), .mask = static_cast<std::uint16_t>(mask)};
}

template <std::size_t most, std::size_t count>
[[nodiscard]] constexpr std::array<AcceptanceFilter, most> acceptance_filters(
    const std::array<std::uint16_t, count>& identifiers) {
  static_assert(most > 0 && count > 0);
  std::array<AcceptanceFilter, count> filters{};
  for (std::size_t i = 0; i < count; ++i) {
    filters[i] = {.id = identifiers[i]};
  }
  std::size_t left = count;
  while (left > most) {
    std::size_t first = 0;
    std::size_t second = 1;
    int widest = std::numeric_limits<int>::min();
    for (std::size_t i = 0; i < left; ++i) {
      for (std::size_t j = i + 1; j < left; ++j) {
        const int bits = std::popcount(merged(filters[i], filters[j]).mask);
        if (bits > widest) {
          widest = bits;
          first = i;
          second = j;
        }
      }
    }
    filters[first] = merged(filters[first], filters[second]);
    filters[second] = filters[--left];
  }
  std::array<AcceptanceFilter, most> found{};
  for (std::size_t i = 0; i < most; ++i) {
    found[i] = filters[i < left ? i : 0];
  }
  return found;
}

}  // namespace striker::bare_metal

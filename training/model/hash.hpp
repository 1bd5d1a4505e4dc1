// SPDX-License-Identifier: Apache-2.0
// FNV-1a, 32 bits (Fowler, Noll, Vo; offset basis 2166136261, prime 16777619): the identity of models,
// configurations and exported policies. Numbers are hashed as the little-endian bytes of their type.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace striker::training {

class Fnv1a {
 public:
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 16777619U; }

  template <class Integer>
  requires std::is_integral_v<Integer>
  void add(Integer value) {
    auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t byte = 0; byte < sizeof(Integer); ++byte) {
      add_byte(static_cast<std::uint8_t>((static_cast<std::uint64_t>(bits) >> (8 * byte)) & 0xFFU));
    }
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(std::string_view text) {
    for (const char character : text) {
      add_byte(static_cast<std::uint8_t>(character));
    }
  }

  [[nodiscard]] std::uint32_t value() const { return hash_; }

 private:
  std::uint32_t hash_ = 2166136261U;
};

inline std::uint32_t fnv1a(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.value();
}

}  // namespace striker::training

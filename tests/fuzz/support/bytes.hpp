// SPDX-License-Identifier: Apache-2.0
// What every fuzz target needs: its input byte by byte, and a way to say which promise broke.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace striker::fuzz {

// An input that has ended reads as zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  [[nodiscard]] bool done() const { return rest_.empty(); }

  std::uint8_t u8() {
    if (rest_.empty()) {
      return 0;
    }
    const std::uint8_t byte = rest_.front();
    rest_ = rest_.subspan(1);
    return byte;
  }
  std::uint32_t u16() {
    const std::uint32_t low = u8();
    return low | static_cast<std::uint32_t>(u8()) << 8U;
  }
  std::uint32_t u32() {
    const std::uint32_t low = u16();
    return low | u16() << 16U;
  }
  std::int32_t i16() { return static_cast<std::int16_t>(u16()); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }

 private:
  std::span<const std::uint8_t> rest_;
};

// An operation is the low five bits of a byte: as a letter of either case, so that seeds are texts. The other
// values, digits and space among them, are operations too.
constexpr std::uint8_t letter(char name) {
  return static_cast<std::uint8_t>(name) & 31U;
}

// Ends the process, as a crash does, if the promise does not hold.
inline void require(bool holds, const char* promise) {
  if (!holds) {
    std::fprintf(stderr, "BROKEN: %s\n", promise);
    std::abort();
  }
}

}  // namespace striker::fuzz

// SPDX-License-Identifier: Apache-2.0
// End-to-end protection after AUTOSAR E2E Profile 2: CRC-8 in byte 0, a 4-bit counter in the low half of
// byte 1. The CRC (polynomial 0x2F, init and final XOR 0xFF) runs over the message's 16-bit data ID, low byte
// first, then bytes 1 to the end. Polynomial 0x2F detects all errors of up to 3 bits at these lengths.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/frame.hpp"

namespace striker::can {

inline constexpr std::uint8_t counter_modulus = 16;

// A jump of up to this many counts is lost frames; a greater one is a broken sequence: that frame is ignored
// and the count starts again from it.
inline constexpr std::uint8_t greatest_counter_step = 7;

namespace crc8 {

inline constexpr std::uint8_t polynomial = 0x2F;
inline constexpr std::uint8_t initial = 0xFF;
inline constexpr std::uint8_t final_xor = 0xFF;

inline constexpr auto table = [] {
  std::array<std::uint8_t, 256> entries{};
  for (std::size_t byte = 0; byte < entries.size(); ++byte) {
    std::uint32_t remainder = static_cast<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder & 0x80U) != 0 ? (remainder << 1U) ^ polynomial : remainder << 1U;
    }
    entries[byte] = static_cast<std::uint8_t>(remainder & 0xFFU);
  }
  return entries;
}();

[[nodiscard]] constexpr std::uint8_t update(std::uint8_t crc, std::uint8_t byte) {
  return table[static_cast<std::size_t>(crc ^ byte)];
}

}  // namespace crc8

[[nodiscard]] constexpr std::uint8_t protection_crc(const Frame& frame, std::uint16_t data_id) {
  std::uint8_t crc = crc8::update(crc8::initial, static_cast<std::uint8_t>(data_id & 0xFFU));
  crc = crc8::update(crc, static_cast<std::uint8_t>(data_id >> 8U));
  for (std::size_t byte = 1; byte < frame.length; ++byte) {
    crc = crc8::update(crc, frame.data[byte]);
  }
  return static_cast<std::uint8_t>(crc ^ crc8::final_xor);
}

constexpr void protect(Frame& frame, std::uint16_t data_id, std::uint8_t counter) {
  frame.data[1] = static_cast<std::uint8_t>((frame.data[1] & 0xF0U) | (counter % counter_modulus));
  frame.data[0] = protection_crc(frame, data_id);
}

[[nodiscard]] constexpr std::uint8_t counter_of(const Frame& frame) {
  return frame.data[1] & 0x0FU;
}

// The AUTOSAR check value of this CRC.
static_assert([] {
  std::uint8_t crc = crc8::initial;
  for (const char digit : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    crc = crc8::update(crc, static_cast<std::uint8_t>(digit));
  }
  return static_cast<std::uint8_t>(crc ^ crc8::final_xor);
}() == 0xDF);

}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// End-to-end protection: AUTOSAR E2E Profile 2 (AUTOSAR_SWS_E2ELibrary, "E2E Profile 2"). CRC-8 in byte 0, a
// 4-bit counter in the low half of byte 1. The CRC (polynomial 0x2F, initial value and final XOR 0xFF) runs
// over bytes 1 to the end and then over the message's 8-bit data ID, which the counter takes from the
// message's list of 16 (SWS_E2E_00119, 00120, 00132).
//
// The lists. A flipped counter bit changes the data ID as well, so that an arbitrary list would lose what the
// polynomial finds. All lists are one list of even-weight bytes, `data_id_base`, XORed with the message's own
// number. The polynomial is divisible by x + 1, so that even weight keeps the parity of an error: odd numbers
// of flips are always found. For pairs of flips the base was searched: no difference of two of its entries
// undoes a flipped counter bit with any other bit of a frame of up to 8 bytes. Every error of 1, 2 or 3 bits in
// a frame is found (tests/can/codec_test.cpp tries them all), and a frame that comes under another message's
// identifier always is.
//
// Example, by any E2E library with data ID list {0x07, 0x01, 0x0E, ...} (message number 7) and counter 1: the
// data 00 01 12 34 56 78 get the CRC `check_vector_crc` below.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/can/frame.hpp"

namespace striker::can {

inline constexpr std::uint8_t counter_modulus = 16;

// A number of the message table's own for each protected message, 1 to 63; 0 has no list: no protection.
using DataIdList = std::uint8_t;
inline constexpr DataIdList unprotected = 0;

inline constexpr std::array<std::uint8_t, counter_modulus> data_id_base = {
    0x00, 0x06, 0x09, 0x0F, 0x18, 0x1E, 0x11, 0x17, 0x21, 0x27, 0x28, 0x2E, 0x39, 0x3F, 0x30, 0x36};

[[nodiscard]] constexpr std::uint8_t data_id(DataIdList list, std::uint8_t counter) {
  return static_cast<std::uint8_t>(data_id_base[counter] ^ list);
}

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

[[nodiscard]] constexpr std::uint8_t counter_of(const Frame& frame) {
  return frame.data[1] & 0x0FU;
}

[[nodiscard]] constexpr std::uint8_t protection_crc(const Frame& frame, DataIdList list) {
  std::uint8_t crc = crc8::initial;
  for (std::size_t byte = 1; byte < frame.length; ++byte) {
    crc = crc8::update(crc, frame.data[byte]);
  }
  crc = crc8::update(crc, data_id(list, counter_of(frame)));
  return static_cast<std::uint8_t>(crc ^ crc8::final_xor);
}

// The counter of a frame whose length and CRC are correct.
[[nodiscard]] constexpr std::optional<std::uint8_t> sound_counter(const Frame& frame, std::uint8_t length,
                                                                  DataIdList list) {
  const bool sound = frame.length == length && frame.data[0] == protection_crc(frame, list);
  return sound ? std::optional(counter_of(frame)) : std::nullopt;
}

constexpr void protect(Frame& frame, DataIdList list, std::uint8_t counter) {
  frame.data[1] = static_cast<std::uint8_t>((frame.data[1] & 0xF0U) | (counter % counter_modulus));
  frame.data[0] = protection_crc(frame, list);
}

// The AUTOSAR check value of this CRC.
static_assert([] {
  std::uint8_t crc = crc8::initial;
  for (const char digit : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    crc = crc8::update(crc, static_cast<std::uint8_t>(digit));
  }
  return static_cast<std::uint8_t>(crc ^ crc8::final_xor);
}() == 0xDF);

inline constexpr std::uint8_t check_vector_crc = 0x13;
static_assert(protection_crc({.id = 0, .length = 6, .data = {0, 0x01, 0x12, 0x34, 0x56, 0x78}}, 7) ==
              check_vector_crc);

}  // namespace striker::can

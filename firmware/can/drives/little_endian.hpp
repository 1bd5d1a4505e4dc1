// SPDX-License-Identifier: Apache-2.0
// What the frames of drives of other makes have in common: whole numbers in bytes, the lowest first, and a rim's speed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/frame.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::can {

[[nodiscard]] constexpr std::uint32_t little_endian_16(const Frame& frame, std::size_t byte) {
  return frame.data[byte] | static_cast<std::uint32_t>(frame.data[byte + 1]) << 8U;
}
[[nodiscard]] constexpr std::uint32_t little_endian_32(const Frame& frame, std::size_t byte) {
  return little_endian_16(frame, byte) | little_endian_16(frame, byte + 2) << 16U;
}

constexpr void put_little_endian_16(Frame& frame, std::size_t byte, std::uint32_t value) {
  frame.data[byte] = static_cast<std::uint8_t>(value & 0xFFU);
  frame.data[byte + 1] = static_cast<std::uint8_t>(value >> 8U & 0xFFU);
}
constexpr void put_little_endian_32(Frame& frame, std::size_t byte, std::uint32_t value) {
  put_little_endian_16(frame, byte, value & 0xFFFFU);
  put_little_endian_16(frame, byte + 2, value >> 16U);
}

template <class Identifiers>
[[nodiscard]] constexpr bool is_among(const Identifiers& identifiers, std::uint16_t identifier) {
  return std::find(identifiers.begin(), identifiers.end(), identifier) != identifiers.end();
}

// To the nearest; nothing beyond what the wheel loops take.
[[nodiscard]] constexpr std::optional<std::int32_t> rim_speed_mm_s(std::int32_t speed_um_s) {
  constexpr std::int32_t greatest_um_s = 1'000 * core::greatest_measured_mm_s;
  if (speed_um_s < -greatest_um_s || speed_um_s > greatest_um_s) {
    return std::nullopt;
  }
  return (speed_um_s + (speed_um_s < 0 ? -500 : 500)) / 1'000;
}

}  // namespace striker::can

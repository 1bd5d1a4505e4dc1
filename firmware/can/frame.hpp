// SPDX-License-Identifier: Apache-2.0
// A classic CAN 2.0A data frame: 11-bit identifier, 0 to 8 bytes. Extended, remote and error frames never
// reach this type; the ports handle them.
#pragma once

#include <array>
#include <cstdint>

namespace striker::can {

struct Frame {
  std::uint16_t id = 0;
  std::uint8_t length = 0;
  // Received frames: how long it had waited when the port handed it over; 255 and more are 255. A port that
  // takes what comes at once leaves 0.
  std::uint8_t age_ms = 0;
  alignas(4) std::array<std::uint8_t, 8> data{};  // read and written as two words

  // What is on the wire.
  friend constexpr bool operator==(const Frame& one, const Frame& other) {
    return one.id == other.id && one.length == other.length && one.data == other.data;
  }
};

static_assert(sizeof(Frame) == 12);

}  // namespace striker::can

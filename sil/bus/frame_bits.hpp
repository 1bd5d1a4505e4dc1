// SPDX-License-Identifier: Apache-2.0
// How many bit times a classic CAN data frame with an 11-bit identifier takes (ISO 11898-1, 10.4 and 10.5):
//
//   stuffed    SOF 1, identifier 11, RTR 1, IDE 1, r0 1, DLC 4, data 8 s, CRC 15   = 34 + 8 s
//   unstuffed  CRC delimiter 1, ACK 1, ACK delimiter 1, EOF 7, intermission 3      = 13
//
// After five equal bits the sender puts in one of the other value; that one counts for the next five.
#pragma once

#include <cstdint>

#include "firmware/can/frame.hpp"

namespace striker::sil {

inline constexpr std::int64_t intermission_bits = 3;

// From the bit in which an error shows to the next start of frame, at most: flags of up to 12 bits, delimiter
// 8, intermission 3, and 8 bits in which an error-passive sender holds back.
inline constexpr std::int64_t error_recovery_bits = 31;

// The most that `bytes` of data can take, intermission included: at worst a stuff bit after the first five
// bits and then after every fourth. 55 + 10 s (Davis, Burns, Bril, Lukkien 2007, equation 1).
[[nodiscard]] constexpr std::int64_t worst_case_frame_bits(std::int64_t bytes) {
  const std::int64_t stuffed = 34 + 8 * bytes;
  return stuffed + 13 + (stuffed - 1) / 4;
}

// What this frame takes, intermission included: its own CRC and its own stuff bits.
[[nodiscard]] std::int64_t frame_bits(const can::Frame& frame);

}  // namespace striker::sil

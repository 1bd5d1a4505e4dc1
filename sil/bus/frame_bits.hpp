// SPDX-License-Identifier: Apache-2.0
// How many bit times a data frame takes, and which of two goes first (ISO 11898-1:2015, 10.4 to 10.6). Classic CAN,
// with s bytes of data:
//
//   stuffed    SOF 1, identifier 11, RTR 1, IDE 1, r0 1, DLC 4, data 8 s, CRC 15            = 34 + 8 s
//              29-bit identifier: SRR 1, IDE 1, 18 more, and r1 1 in place of IDE 1         = 54 + 8 s
//   unstuffed  CRC delimiter 1, ACK 1, ACK delimiter 1, EOF 7, intermission 3               = 13
//
// CAN FD. The bit rate may change in the BRS bit, at its sample point, and change back in the CRC delimiter, at its:
// together they take as long as one bit of each rate. So BRS counts here, the delimiter there:
//
//   arbitration  SOF 1, identifier 11, RRS 1, IDE 1, FDF 1, res 1, BRS 1                    = 17
//                29-bit identifier: SRR 1 and 18 more                                       = 36
//   data         ESI 1, DLC 4, data 8 s; then no longer stuffed by need: stuff count 4,
//                CRC 17 (21 beyond 16 bytes), a fixed stuff bit before every fourth of
//                both 6 (7), CRC delimiter 1                                                = 33 (38) + 8 s
//   arbitration  ACK 1, ACK delimiter 1, EOF 7, intermission 3                              = 12
//
// After five equal bits the sender puts in one of the other value; that one counts for the next five.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "firmware/can/frame.hpp"

namespace striker::sil {

struct FrameFormat {
  bool extended = false;         // a 29-bit identifier
  bool fd = false;               // CAN FD
  bool bit_rate_switch = false;  // BRS, of CAN FD alone: the data part goes at a second bit rate

  bool operator==(const FrameFormat&) const = default;
};

inline constexpr std::int64_t intermission_bits = 3;

// From the bit in which an error shows to the next start of frame, at most: flags of up to 12 bits, delimiter
// 8, intermission 3, and 8 bits in which an error-passive sender holds back. An error ends the second bit rate.
inline constexpr std::int64_t error_recovery_bits = 31;

// The most that `bytes` of data can take, intermission included: at worst a stuff bit after the first five
// bits and then after every fourth. 55 + 10 s (Davis, Burns, Bril, Lukkien 2007, equation 1).
[[nodiscard]] constexpr std::int64_t worst_case_frame_bits(std::int64_t bytes) {
  const std::int64_t stuffed = 34 + 8 * bytes;
  return stuffed + 13 + (stuffed - 1) / 4;
}

// The data length that a frame has for `bytes`, 0 to 64: those that a DLC can say.
[[nodiscard]] constexpr std::int64_t fd_length(std::int64_t bytes) {
  constexpr std::array<std::int64_t, 7> steps = {12, 16, 20, 24, 32, 48, 64};
  return bytes <= 8 ? bytes : *std::lower_bound(steps.begin(), steps.end() - 1, bytes);
}

struct FrameBits {
  std::int64_t arbitration = 0;  // at the bus's bit rate; of classic CAN all
  std::int64_t data = 0;         // at the second, if the frame switches
};

// The most that `bytes` of data can take, intermission included. Classic with a 29-bit identifier 80 + 10 s (the
// same with 54 stuffed bits in place of 34). CAN FD: up to FDF at most 3 stuff bits, 7 with 29 bits, because RRS,
// IDE and FDF break runs; from BRS at most one in four bits, which is 1 + 2 s. So 32 (55) bits of arbitration, and
// 34 + 10 s (39 + 10 s beyond 16 bytes) of data.
[[nodiscard]] constexpr FrameBits worst_case_frame_bits(std::int64_t bytes, const FrameFormat& format) {
  if (!format.fd) {
    return {.arbitration = worst_case_frame_bits(bytes) + (format.extended ? 25 : 0)};
  }
  const std::int64_t length = fd_length(bytes);
  return {.arbitration = format.extended ? 36 + 7 + 12 : 17 + 3 + 12,
          .data = (length > 16 ? 38 : 33) + 8 * length + (1 + 2 * length)};
}

// Of two identifiers the lower rank wins the arbitration. The first 11 bits are compared, then IDE: with equal 11 bits
// the shorter identifier wins.
[[nodiscard]] constexpr std::uint32_t arbitration_rank(std::uint32_t id, bool extended) {
  constexpr unsigned extension_bits = 18;
  return extended ? (id >> extension_bits << (extension_bits + 1)) | 1U << extension_bits |
                        (id & ((1U << extension_bits) - 1))
                  : id << (extension_bits + 1);
}

// What this frame takes, intermission included: its own CRC and its own stuff bits.
[[nodiscard]] std::int64_t frame_bits(const can::Frame& frame);

}  // namespace striker::sil

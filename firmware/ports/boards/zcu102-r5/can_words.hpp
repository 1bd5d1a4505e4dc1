// SPDX-License-Identifier: Apache-2.0
// Frames, filters and bit timing as the registers of the Zynq UltraScale+'s CAN controller have them (AMD UG1085,
// "CAN Controller"; UG1087, module CAN): four words a frame, two a filter.
//
// QEMU 7.2's model of the controller differs in two things, and a driver that is right for the one is wrong for the
// other. It puts the identifier's register on the bus as SocketCAN has identifiers (the number itself; flags in bits 29
// to 31), where the hardware has it in bits 21 to 31; and the first data byte is a data word's lowest, where it is
// the hardware's highest. The hardware's encoding is the default; STRIKER_FOR_QEMU builds the other.
#pragma once

#include <cstdint>

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/can_driver/acceptance.hpp"

namespace striker::zcu102 {

enum class Encoding : std::uint8_t { hardware, qemu };

struct FrameWords {
  std::uint32_t id = 0;
  std::uint32_t length = 0;  // of a received frame also its time stamp, in bits 0 to 15
  std::uint32_t data1 = 0;
  std::uint32_t data2 = 0;

  friend constexpr bool operator==(const FrameWords&, const FrameWords&) = default;
};

// Passes what equals `id` in the bits of `mask`.
struct FilterWords {
  std::uint32_t mask = 0;
  std::uint32_t id = 0;

  friend constexpr bool operator==(const FilterWords&, const FilterWords&) = default;
};

template <Encoding encoding>
struct CanWords {
  static constexpr bool is_hardware = encoding == Encoding::hardware;
  static constexpr std::uint32_t id_shift = is_hardware ? 21 : 0;
  // Hardware: SRRRTR, which is a standard frame's remote bit, and IDE. QEMU: error, remote and extended, as in linux/can.h.
  static constexpr std::uint32_t other_than_data = is_hardware ? 3U << 19U : 7U << 29U;
  static constexpr std::uint32_t length_shift = 28;

  [[nodiscard]] static constexpr FrameWords encode(const can::Frame& frame) {
    return {.id = static_cast<std::uint32_t>(frame.id) << id_shift,
            .length = static_cast<std::uint32_t>(frame.length) << length_shift,
            .data1 = word(frame.data, 0),
            .data2 = word(frame.data, 4)};
  }

  // False, with `frame` as it was, if it is no standard data frame of at most 8 bytes.
  [[nodiscard]] static constexpr bool decode(const FrameWords& words, can::Frame& frame) {
    const std::uint32_t length = words.length >> length_shift;
    if ((words.id & other_than_data) != 0 || length > frame.data.size()) {
      return false;
    }
    frame = {.id = static_cast<std::uint16_t>(words.id >> id_shift & bare_metal::every_bit_of_identifier),
             .length = static_cast<std::uint8_t>(length)};
    for (std::uint32_t i = 0; i < length; ++i) {
      frame.data[i] = static_cast<std::uint8_t>((i < 4 ? words.data1 : words.data2) >> shift_of(i));
    }
    return true;
  }

  // Standard data frames alone, whatever the filter.
  [[nodiscard]] static constexpr FilterWords encode(const bare_metal::AcceptanceFilter& filter) {
    return {.mask = static_cast<std::uint32_t>(filter.mask) << id_shift | other_than_data,
            .id = static_cast<std::uint32_t>(filter.id) << id_shift};
  }

 private:
  static constexpr std::uint32_t shift_of(std::uint32_t byte) {
    return 8 * (is_hardware ? 3 - byte % 4 : byte % 4);
  }
  static constexpr std::uint32_t word(const std::array<std::uint8_t, 8>& data, std::uint32_t first) {
    std::uint32_t all = 0;
    for (std::uint32_t i = first; i < first + 4; ++i) {
      all |= static_cast<std::uint32_t>(data[i]) << shift_of(i);
    }
    return all;
  }
};

// What the two timing registers hold.
struct BitTiming {
  std::uint32_t prescaler = 0;  // BRPR: clocks a quantum, less one
  std::uint32_t segments = 0;   // BTR: jump width, phase 2, propagation and phase 1, each less one
};

// 1 Mbit/s in 20 quanta: 1 of synchronisation, 14, and 5 after the sample point, at 75 %; jump width 4.
[[nodiscard]] constexpr BitTiming bit_timing(std::uint32_t clock_hz) {
  constexpr std::uint32_t quanta_hz = 20 * 1'000'000;
  return {.prescaler = (clock_hz + quanta_hz / 2) / quanta_hz - 1, .segments = 3U << 7U | 4U << 4U | 13U};
}

// The clock gives 1 Mbit/s within 0.1 %. Some ZCU102 have 99.99 MHz.
[[nodiscard]] constexpr bool suits_bit_rate(std::uint32_t clock_hz) {
  constexpr std::uint32_t quanta_hz = 20 * 1'000'000;
  const std::uint32_t nearest_hz = (clock_hz + quanta_hz / 2) / quanta_hz * quanta_hz;
  const std::uint32_t off_hz = nearest_hz > clock_hz ? nearest_hz - clock_hz : clock_hz - nearest_hz;
  return nearest_hz != 0 && nearest_hz / quanta_hz <= 256 && off_hz <= nearest_hz / 1'000;
}

}  // namespace striker::zcu102

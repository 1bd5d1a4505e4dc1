// SPDX-License-Identifier: Apache-2.0
// The vocabulary of the message table: what a signal and a message are, and when a table is sound.
//
// A message is a plain struct of 32-bit integers, one a signal, in raw counts. Bits are numbered as in a DBC
// with little-endian signals: bit 0 is the lowest of byte 0. In protected messages bits 0 to 11 belong to
// E2E.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "firmware/can/e2e.hpp"

// A build may move the identifiers (STRIKER_CAN_BASE; a robot's description says identifier_base): by as much for all
// but the three least urgent, which stay at the end of the range. Whatever else is on the bus is not asked; drives of
// another make are (drives/drive_protocol.hpp).
#ifndef STRIKER_CAN_BASE
#define STRIKER_CAN_BASE 0
#endif

namespace striker::can {

inline constexpr std::int32_t identifier_base = STRIKER_CAN_BASE;
inline constexpr std::int32_t first_identifier_that_stays = 0x700;

// 0 to 0x5D8: the last that is moved stays below the first that is not.
static_assert(identifier_base >= 0 && identifier_base % 8 == 0 && identifier_base <= 0x5D8,
              "STRIKER CAN: identifier_base must be a multiple of 8 from 0 to 1496 (0x5D8)");

[[nodiscard]] constexpr std::uint16_t moved(std::uint16_t identifier) {
  return static_cast<std::uint16_t>(identifier < first_identifier_that_stays ? identifier + identifier_base
                                                                             : identifier);
}

// digits * 10^exponent: scales stay exact without floating point.
struct Decimal {
  std::int64_t digits = 1;
  std::int32_t exponent = 0;
};

namespace units {
inline constexpr Decimal one = {1, 0};
inline constexpr Decimal two = {2, 0};
inline constexpr Decimal quarter = {25, -2};
inline constexpr Decimal circle_65536th_deg = {54931640625, -13};
inline constexpr Decimal one_256th = {390625, -8};
}  // namespace units

inline constexpr std::int32_t greatest_31_bits = std::numeric_limits<std::int32_t>::max();

struct NamedValue {
  std::int32_t raw;
  std::string_view name;
};

// The values of an enumeration that counts from 0, from its names.
template <std::size_t Count>
[[nodiscard]] constexpr std::array<NamedValue, Count> named_values(
    const std::array<std::string_view, Count>& names) {
  std::array<NamedValue, Count> values{};
  for (std::size_t i = 0; i < Count; ++i) {
    values[i] = {static_cast<std::int32_t>(i), names[i]};
  }
  return values;
}

template <std::size_t Count>
[[nodiscard]] constexpr std::int32_t last_of(const std::array<NamedValue, Count>& values) {
  return values.back().raw;
}

template <class Message>
struct Signal {
  std::string_view name;
  std::int32_t Message::*field;
  std::uint8_t first_bit;
  std::uint8_t bits;  // 1 to 31 unsigned, 2 to 32 signed
  bool is_signed = false;
  std::int32_t minimum = 0;  // raw; a receiver ignores a message with any signal outside
  std::int32_t maximum = 0;
  Decimal scale = {};
  std::string_view unit = {};
  std::span<const NamedValue> values = {};
};

enum class Node : std::uint8_t { controller, drives, operator_, simulator, team, vision };

inline constexpr std::array<std::string_view, 6> node_names = {"Controller", "Drives", "Operator",
                                                               "Simulator",  "Team",   "Vision"};

// What a bus analysis needs to know beyond the period (see sil/budget/response_time.hpp).
struct Traffic {
  std::uint16_t distance_ms = 0;  // shortest time from one frame to the next; 0: the period
  std::uint8_t burst = 1;         // burst - 1 frames more than one a period may come, as on changes
  std::uint16_t deadline_ms = 0;  // from queueing to reception; 0: the period, or the distance of events
  bool awaited = false;           // a peer waits for it, however late: no deadline, and no part of a budget
};

constexpr Traffic on_events(std::uint16_t distance_ms) {
  return {.distance_ms = distance_ms};
}

constexpr Traffic on_changes(std::uint16_t distance_ms, std::uint8_t burst) {
  return {.distance_ms = distance_ms, .burst = burst};
}

constexpr Traffic awaited_by_its_receiver() {
  return {.awaited = true};
}

constexpr Traffic due_within(std::uint16_t deadline_ms) {
  return {.deadline_ms = deadline_ms};
}

struct MessageInfo {
  std::string_view name;
  std::uint16_t id;
  std::uint8_t length;
  Node sender;
  std::uint16_t period_ms = 0;        // 0: on events
  std::uint16_t timeout_ms = 0;       // a receiver's freshness limit; 0: none
  DataIdList data_ids = unprotected;  // for E2E
  std::string_view comment = {};
  Traffic traffic = {};
};

template <class Message, std::size_t Signals>
struct Layout {
  MessageInfo info;
  std::array<Signal<Message>, Signals> signals;
};

// Specialised once for every message, beside it in messages/.
template <class Message>
inline constexpr auto layout = nullptr;

namespace detail {

constexpr std::uint64_t bit_mask(unsigned bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

template <class Message>
constexpr bool range_is_representable(const Signal<Message>& signal) {
  const int value_bits = signal.is_signed ? signal.bits - 1 : signal.bits;
  const std::int64_t greatest = (std::int64_t{1} << value_bits) - 1;
  const std::int64_t least = signal.is_signed ? -greatest - 1 : 0;
  return value_bits <= 31 && least <= signal.minimum && signal.minimum <= signal.maximum &&
         signal.maximum <= greatest;
}

}  // namespace detail

// Signals fit the length, do not overlap each other or the E2E bits, and their ranges fit their bits; a
// period or a distance bounds how often the message comes.
template <class Message>
constexpr bool layout_is_sound() {
  const auto& [info, signals] = layout<Message>;
  std::uint64_t taken = info.data_ids == unprotected ? 0 : detail::bit_mask(12);
  bool sound = info.id <= 0x7FF && info.length >= 1 && info.length <= 8 && info.traffic.burst >= 1 &&
               (info.period_ms > 0 || info.traffic.distance_ms > 0);
  for (const auto& signal : signals) {
    const std::uint64_t bits = detail::bit_mask(signal.bits) << signal.first_bit;
    sound = sound && signal.bits >= 1 && signal.first_bit + signal.bits <= 8 * info.length &&
            (taken & bits) == 0 && detail::range_is_representable(signal);
    taken |= bits;
  }
  return sound;
}

}  // namespace striker::can

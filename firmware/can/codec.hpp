// SPDX-License-Identifier: Apache-2.0
// Packs, protects, checks and unpacks: from a message to a frame and back, driven by the table alone.
//
// Receive order: identifier (the caller's dispatch), exact length, CRC, range; then the whole message is taken, or
// none of it. The order of the frames is MessageReceiver's business (message_receiver.hpp).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "firmware/can/e2e.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"

namespace striker::can {

// What a receive check found: the first that failed, in the order in which they are made. `wrong_counter`: the
// frame itself is sound, but repeated, or its message is not to be believed now.
enum class Verdict : std::uint8_t { accepted, wrong_length, wrong_crc, wrong_counter, out_of_range };

// A sender's E2E counter for one message.
struct SendCounter {
  std::uint8_t next = 0;
};

namespace detail {

// Bit 0 of a payload is the lowest of byte 0: a little-endian processor loads it as it is.
static_assert(std::endian::native == std::endian::little);

template <class Message, std::size_t i>
constexpr std::int32_t extract(std::uint64_t payload) {
  constexpr const auto& signal = layout<Message>.signals[i];
  const auto raw = static_cast<std::uint32_t>((payload >> signal.first_bit) & bit_mask(signal.bits));
  constexpr std::uint32_t sign = signal.is_signed ? std::uint32_t{1} << (signal.bits - 1) : 0;
  return static_cast<std::int32_t>((raw ^ sign) - sign);
}

// False if the value is outside the signal's range.
template <class Message, std::size_t i>
constexpr bool take_signal(std::uint64_t payload, Message& message) {
  constexpr const auto& signal = layout<Message>.signals[i];
  const std::int32_t value = extract<Message, i>(payload);
  message.*signal.field = value;
  return value >= signal.minimum && value <= signal.maximum;
}

template <class Message, std::size_t i>
constexpr std::uint64_t put_signal(const Message& message) {
  constexpr const auto& signal = layout<Message>.signals[i];
  const std::int32_t value = std::clamp(message.*signal.field, signal.minimum, signal.maximum);
  return (static_cast<std::uint64_t>(value) & bit_mask(signal.bits)) << signal.first_bit;
}

// The signals of a message, one after the other, each with its bits known to the compiler: shifts and masks of
// 64 bits by amounts in a table are calls on the small cores.
template <class Message>
using SignalIndices = std::make_index_sequence<layout<Message>.signals.size()>;

template <class Message, std::size_t... i>
constexpr bool take_signals(std::uint64_t payload, Message& message, std::index_sequence<i...>) {
  return (take_signal<Message, i>(payload, message) && ...);
}

template <class Message, std::size_t... i>
constexpr std::uint64_t put_signals(const Message& message, std::index_sequence<i...>) {
  return (put_signal<Message, i>(message) | ...);
}

// The messages of every tick have the CRC's loop where they need it; the others share one, which saves flash.
template <class Message>
inline constexpr bool comes_every_tick = layout<Message>.info.period_ms == 1;

[[nodiscard, gnu::noinline]] constexpr bool shared_crc_fits(const Frame& frame, DataIdList list) {
  return frame.data[0] == protection_crc(frame, list);
}
[[gnu::noinline]] constexpr void shared_protect(Frame& frame, DataIdList list, std::uint8_t counter) {
  protect(frame, list, counter);
}

template <class Message>
constexpr bool crc_fits(const Frame& frame) {
  constexpr DataIdList list = layout<Message>.info.data_ids;
  return comes_every_tick<Message> ? frame.data[0] == protection_crc(frame, list)
                                   : shared_crc_fits(frame, list);
}

template <class Message>
constexpr void protect_as(Frame& frame, std::uint8_t counter) {
  constexpr DataIdList list = layout<Message>.info.data_ids;
  if constexpr (comes_every_tick<Message>) {
    protect(frame, list, counter);
  } else {
    shared_protect(frame, list, counter);
  }
}

}  // namespace detail

// Values outside a signal's range are sent as its nearest end.
template <class Message>
[[nodiscard]] constexpr Frame pack(const Message& message) {
  constexpr const MessageInfo& info = layout<Message>.info;
  const std::uint64_t payload = detail::put_signals(message, detail::SignalIndices<Message>{});
  return {.id = info.id, .length = info.length, .data = std::bit_cast<std::array<std::uint8_t, 8>>(payload)};
}

template <class Message>
[[nodiscard]] constexpr Frame send(const Message& message, SendCounter& counter) {
  static_assert(layout<Message>.info.data_ids != unprotected,
                "this message carries no E2E protection: pack it");
  Frame frame = pack(message);
  detail::protect_as<Message>(frame, counter.next);
  counter.next = static_cast<std::uint8_t>((counter.next + 1) % counter_modulus);
  return frame;
}

// Length and range only: for messages without protection.
template <class Message>
[[nodiscard]] constexpr Verdict unpack(const Frame& frame, Message& message) {
  constexpr const auto& table = layout<Message>;
  if (frame.length != table.info.length) {
    return Verdict::wrong_length;
  }
  const auto payload = std::bit_cast<std::uint64_t>(frame.data);
  Message taken;
  if (!detail::take_signals(payload, taken, detail::SignalIndices<Message>{})) {
    return Verdict::out_of_range;
  }
  message = taken;
  return Verdict::accepted;
}

// One frame for itself: length, CRC, range.
template <class Message>
[[nodiscard]] constexpr Verdict receive(const Frame& frame, Message& message) {
  constexpr const MessageInfo& info = layout<Message>.info;
  static_assert(info.data_ids != unprotected, "this message carries no E2E protection: unpack it");
  if (frame.length != info.length) {
    return Verdict::wrong_length;
  }
  if (!detail::crc_fits<Message>(frame)) {
    return Verdict::wrong_crc;
  }
  return unpack(frame, message);
}

// A frame of this message that a receiver would accept.
template <class Message>
[[nodiscard]] constexpr bool is_valid(const Frame& frame) {
  Message message;
  return is<Message>(frame) && receive(frame, message) == Verdict::accepted;
}

}  // namespace striker::can

// Packs, protects, checks and unpacks: from a message to a frame and back, driven by the table alone.
//
// Receive order: identifier (the caller's dispatch), exact length, CRC, counter, range; then the whole
// message is taken, or none of it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/can/e2e.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"

namespace striker::can {

enum class Verdict : std::uint8_t { accepted, wrong_length, wrong_crc, wrong_counter, out_of_range };

// A sender's E2E counter for one message.
struct SendCounter {
  std::uint8_t next = 0;
};

// A receiver's memory of one message's E2E counter. Forget it when the message times out: a sender that comes
// back may start anywhere.
struct ReceiveCounter {
  bool seen = false;
  std::uint8_t last = 0;
};

namespace detail {

constexpr std::uint64_t payload_of(const Frame& frame) {
  std::uint64_t payload = 0;
  for (std::size_t byte = 0; byte < 8; ++byte) {
    payload |= std::uint64_t{frame.data[byte]} << (8 * byte);
  }
  return payload;
}

constexpr std::int32_t extract(std::uint64_t payload, unsigned first_bit, unsigned bits, bool is_signed) {
  const auto raw = static_cast<std::uint32_t>((payload >> first_bit) & bit_mask(bits));
  const std::uint32_t sign = is_signed ? std::uint32_t{1} << (bits - 1) : 0;
  return static_cast<std::int32_t>((raw ^ sign) - sign);
}

constexpr bool counter_follows(ReceiveCounter& memory, std::uint8_t counter) {
  const auto advance = static_cast<std::uint8_t>((counter - memory.last) & (counter_modulus - 1));
  const bool follows = !memory.seen || (advance >= 1 && advance <= greatest_counter_step);
  memory = {true, counter};
  return follows;
}

}  // namespace detail

// Values outside a signal's range are sent as its nearest end.
template <class Message>
[[nodiscard]] constexpr Frame pack(const Message& message) {
  constexpr const auto& table = layout<Message>;
  std::uint64_t payload = 0;
  for (const auto& signal : table.signals) {
    const std::int32_t value = std::clamp(message.*signal.field, signal.minimum, signal.maximum);
    payload |= (static_cast<std::uint64_t>(value) & detail::bit_mask(signal.bits)) << signal.first_bit;
  }
  Frame frame{table.info.id, table.info.length, {}};
  for (std::size_t byte = 0; byte < 8; ++byte) {
    frame.data[byte] = static_cast<std::uint8_t>((payload >> (8 * byte)) & 0xFFU);
  }
  return frame;
}

template <class Message>
[[nodiscard]] constexpr Frame send(const Message& message, SendCounter& counter) {
  static_assert(layout<Message>.info.data_id != unprotected,
                "this message carries no E2E protection: pack it");
  Frame frame = pack(message);
  protect(frame, layout<Message>.info.data_id, counter.next);
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
  const std::uint64_t payload = detail::payload_of(frame);
  Message taken;
  for (const auto& signal : table.signals) {
    const std::int32_t value = detail::extract(payload, signal.first_bit, signal.bits, signal.is_signed);
    if (value < signal.minimum || value > signal.maximum) {
      return Verdict::out_of_range;
    }
    taken.*signal.field = value;
  }
  message = taken;
  return Verdict::accepted;
}

template <class Message>
[[nodiscard]] constexpr Verdict receive(const Frame& frame, ReceiveCounter& counter, Message& message) {
  constexpr const MessageInfo& info = layout<Message>.info;
  static_assert(info.data_id != unprotected, "this message carries no E2E protection: unpack it");
  if (frame.length != info.length) {
    return Verdict::wrong_length;
  }
  if (frame.data[0] != protection_crc(frame, info.data_id)) {
    return Verdict::wrong_crc;
  }
  if (!detail::counter_follows(counter, counter_of(frame))) {
    return Verdict::wrong_counter;
  }
  return unpack(frame, message);
}

}  // namespace striker::can

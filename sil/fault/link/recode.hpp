// SPDX-License-Identifier: Apache-2.0
// Protected messages in passing: read from a frame, and put back with another content, as the sender itself would
// have sent it, counter and CRC included.
#pragma once

#include <optional>

#include "firmware/can/codec.hpp"

namespace striker::sil {

// The frame's message if length, CRC and ranges are right, whatever its counter.
template <class Message>
[[nodiscard]] std::optional<Message> read(const can::Frame& frame) {
  Message message;
  const bool sound = can::is<Message>(frame) && can::receive(frame, message) == can::Verdict::accepted;
  return sound ? std::optional(message) : std::nullopt;
}

// In the place of `frame`, with its counter.
template <class Message>
[[nodiscard]] can::Frame with_counter_of(const can::Frame& frame, const Message& message) {
  can::SendCounter counter{.next = can::counter_of(frame)};
  return can::send(message, counter);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Protected messages in passing: read from a frame, and put back with another content, as the sender itself would
// have sent it, counter and CRC included.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "firmware/can/codec.hpp"

namespace striker::sil {

// The frame's message if length, CRC and ranges are right, whatever its counter.
template <class Message>
[[nodiscard]] std::optional<Message> read(const can::Frame& frame) {
  Message message;
  if (!can::is<Message>(frame)) {
    return std::nullopt;
  }
  if constexpr (can::layout<Message>.info.data_id == can::unprotected) {
    return can::unpack(frame, message) == can::Verdict::accepted ? std::optional(message) : std::nullopt;
  } else {
    can::ReceiveCounter any;
    return can::receive(frame, any, message) == can::Verdict::accepted ? std::optional(message)
                                                                       : std::nullopt;
  }
}

// In the place of `frame`, with its counter.
template <class Message>
[[nodiscard]] can::Frame with_counter_of(const can::Frame& frame, const Message& message) {
  can::SendCounter counter{.next = can::counter_of(frame)};
  return can::send(message, counter);
}

// Says that the frame has waited this long. A port that hands frames over at once has no such member.
template <class Frame>
void set_age(Frame& frame, std::uint32_t age_ms) {
  if constexpr (requires { frame.age_ms; }) {
    frame.age_ms = static_cast<std::uint8_t>(std::min<std::uint32_t>(age_ms, 255));
  }
}

}  // namespace striker::sil

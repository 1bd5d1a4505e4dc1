// SPDX-License-Identifier: Apache-2.0
// Frames that an attacker on the bus can make: he knows the message table and its checksums.
#pragma once

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "tests/fuzz/support/bytes.hpp"

namespace striker::fuzz {

inline can::Frame raw_frame(Bytes& bytes) {
  can::Frame frame;
  frame.id = static_cast<std::uint16_t>(bytes.u16() & 0x7FFU);
  frame.length = bytes.u8() % 9;
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    frame.data[byte] = bytes.u8();
  }
  return frame;
}

// Of a message of the table: arbitrary payload, with a correct checksum if the message has one.
inline can::Frame forged_frame(Bytes& bytes) {
  constexpr auto messages = std::tuple_size_v<can::Messages>;
  const std::size_t wanted = bytes.u8() % messages;
  can::Frame frame;
  std::size_t number = 0;
  can::for_each_layout([&](const auto& message) {
    if (number++ == wanted) {
      frame.id = message.info.id;
      frame.length = message.info.length;
      for (std::size_t byte = 0; byte < frame.length; ++byte) {
        frame.data[byte] = bytes.u8();
      }
      if (message.info.data_ids != can::unprotected) {
        can::protect(frame, message.info.data_ids, can::counter_of(frame));
      }
    }
  });
  return frame;
}

template <class Message>
bool holds(const can::Frame& frame, Message& message) {
  return can::is<Message>(frame) && can::receive(frame, message) == can::Verdict::accepted;
}

template <class Message>
bool is_correct(const can::Frame& frame) {
  Message message;
  return holds(frame, message);
}

// Would a drive of Striker's own that believes this frame turn a wheel?
inline bool moves(const can::Frame& frame) {
  can::WheelCommand command;
  return holds(frame, command) && (command.left_torque_mNm != 0 || command.right_torque_mNm != 0 ||
                                   command.left_set_point_2mm_s != 0 || command.right_set_point_2mm_s != 0);
}

}  // namespace striker::fuzz

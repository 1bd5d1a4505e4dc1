// SPDX-License-Identifier: Apache-2.0
// What a controller may put on its bus: the messages that the table says it sends, each with its own length, and
// what its drives are told where they are of another make, which the table does not have.
//
// The gate asks for every frame, after everything else and whatever made it. It is other code than what makes
// the frames: it knows identifiers and lengths alone, and nothing of the controller.
#pragma once

#include <algorithm>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"

namespace striker::safety {

template <can::DriveProtocol Drives>
[[nodiscard]] constexpr bool may_send(const can::Frame& frame) {
  const bool listed = can::any_layout([&](const auto& message) {
    return message.info.sender == can::Node::controller && message.info.id == frame.id &&
           message.info.length == frame.length;
  });
  const auto in_table = [&] {
    return can::any_layout([&](const auto& message) { return message.info.id == frame.id; });
  };
  if constexpr (can::ForeignDrives<Drives>) {
    return listed || (!in_table() && Drives::may_send(frame));
  }
  return listed || (frame.length <= frame.data.size() && !in_table() &&
                    std::find(Drives::sends.begin(), Drives::sends.end(), frame.id) != Drives::sends.end());
}

}  // namespace striker::safety

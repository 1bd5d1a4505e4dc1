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
  bool in_table = false;
  bool listed = false;
  can::for_each_layout([&](const auto& message) {
    const bool same = message.info.id == frame.id;
    in_table = in_table || same;
    listed = listed ||
             (same && message.info.sender == can::Node::controller && message.info.length == frame.length);
  });
  if (in_table) {
    return listed;
  }
  return frame.length <= frame.data.size() &&
         std::find(Drives::sends.begin(), Drives::sends.end(), frame.id) != Drives::sends.end();
}

}  // namespace striker::safety

// SPDX-License-Identifier: Apache-2.0
// What a controller may put on its bus: the messages that the table says it sends, each with its own length.
//
// The loop asks for every frame, after everything else and whatever made it. It is other code than what makes
// the frames: it knows identifiers and lengths alone, and nothing of the controller.
#pragma once

#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"

namespace striker::safety {

[[nodiscard]] constexpr bool may_send(const can::Frame& frame) {
  bool listed = false;
  can::for_each_layout([&](const auto& message) {
    listed = listed || (message.info.sender == can::Node::controller && message.info.id == frame.id &&
                        message.info.length == frame.length);
  });
  return listed;
}

}  // namespace striker::safety

// SPDX-License-Identifier: Apache-2.0
// Which messages the controller sends, from the message table.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/can/messages.hpp"

namespace striker::sil {

inline constexpr std::size_t controller_message_count = can::messages_from(can::Node::controller);

// In the order of the table.
inline constexpr auto controller_identifiers = [] {
  std::array<std::uint16_t, controller_message_count> identifiers{};
  std::size_t count = 0;
  can::for_each_layout([&](const auto& message) {
    if (message.info.sender == can::Node::controller) {
      identifiers[count++] = message.info.id;
    }
  });
  return identifiers;
}();

[[nodiscard]] constexpr bool is_controllers(const can::Frame& frame) {
  return std::find(controller_identifiers.begin(), controller_identifiers.end(), frame.id) !=
         controller_identifiers.end();
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Which messages the controller sends: those that the message table says, and what this build's drives are told where they
// are of another make.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/can/messages.hpp"
#include "firmware/loop/built_in_robot.hpp"

namespace striker::sil {

inline constexpr bool has_foreign_drives = can::ForeignDrives<loop::BuiltInDrives>;

inline constexpr std::size_t controller_message_count =
    can::messages_from(can::Node::controller) + (has_foreign_drives ? loop::BuiltInDrives::sends.size() : 0);

// In the order of the table, then those of the drives.
inline constexpr auto controller_identifiers = [] {
  std::array<std::uint16_t, controller_message_count> identifiers{};
  std::size_t count = 0;
  can::for_each_layout([&](const auto& message) {
    if (message.info.sender == can::Node::controller) {
      identifiers[count++] = message.info.id;
    }
  });
  if constexpr (has_foreign_drives) {
    std::copy(loop::BuiltInDrives::sends.begin(), loop::BuiltInDrives::sends.end(), &identifiers[count]);
  }
  return identifiers;
}();

[[nodiscard]] constexpr bool is_controllers(const can::Frame& frame) {
  return std::find(controller_identifiers.begin(), controller_identifiers.end(), frame.id) !=
         controller_identifiers.end();
}

// What the wheels are told.
[[nodiscard]] constexpr bool is_drive_command(const can::Frame& frame) {
  const auto& sends = loop::BuiltInDrives::sends;
  return std::find(sends.begin(), sends.end(), frame.id) != sends.end();
}

}  // namespace striker::sil

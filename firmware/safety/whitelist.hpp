// SPDX-License-Identifier: Apache-2.0
// What a controller may put on its bus: the messages that the table says it sends, each with its own length, and
// what its drives are told where they are of another make, which the table does not have.
//
// The gate asks for every frame, after everything else and whatever made it. It is other code than what makes
// the frames: it knows identifiers and lengths alone, and nothing of the controller.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"

namespace striker::safety {

namespace detail {

// The messages of the table, each in a place of its own: one look, the same for every frame, and bounded as such
// (tools/step_bound).
inline constexpr std::size_t places = 16;
static_assert(can::messages_from(can::Node::controller) <= places);

constexpr std::size_t place_of(std::uint32_t id, std::uint32_t multiplier) {
  return id * multiplier >> 8U & (places - 1);
}
constexpr std::uint32_t word_of(std::uint32_t id, std::uint32_t length) {
  return id | length << 16U;
}

constexpr bool separates(std::uint32_t multiplier) {
  std::uint32_t taken = 0;
  return !can::any_layout([&](const auto& message) {
    const bool own = message.info.sender == can::Node::controller;
    const std::uint32_t bit = own ? 1U << place_of(message.info.id, multiplier) : 0;
    const bool clashes = (taken & bit) != 0;
    taken |= bit;
    return clashes;
  });
}

inline constexpr std::uint32_t multiplier = [] {
  std::uint32_t found = 1;
  while (!separates(found)) {
    ++found;
  }
  return found;
}();

inline constexpr std::array<std::uint32_t, places> listed = [] {
  std::array<std::uint32_t, places> words{};
  words.fill(0xFFFF'FFFFU);  // no frame's
  can::for_each_layout([&](const auto& message) {
    if (message.info.sender == can::Node::controller) {
      words[place_of(message.info.id, multiplier)] = word_of(message.info.id, message.info.length);
    }
  });
  return words;
}();

}  // namespace detail

template <can::DriveProtocol Drives>
[[nodiscard]] constexpr bool may_send(const can::Frame& frame) {
  const bool listed = detail::listed[detail::place_of(frame.id, detail::multiplier)] ==
                      detail::word_of(frame.id, frame.length);
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

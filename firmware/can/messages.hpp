// SPDX-License-Identifier: Apache-2.0
// The message table: the single source of every frame on the bus. It packs and unpacks, drives the receive
// checks, is verified by the compiler, and prints the DBC (`striker-dbc`).
//
// Classic CAN 2.0A, 1 Mbit/s, one bus a robot. Identifiers go by function, so that priority does too. Each
// message stands in messages/ as a struct of raw counts, whose names carry the unit of a count, followed by
// its layout.
//
// `striker-bus-budget` shows from this table whether every deadline is met. Status and FaultReport come on
// changes too, at most one a tick; a picture may bring its decision 5 ticks early, and has to come within
// that window.
//
// `protocol_version` rises with every change that makes a frame of the old version mean something else, or
// makes it refused: a signal moved, rescaled or given another range, another data ID, identifier or length, a
// message that a peer has to send or to await. A message, a named value, or a signal in free bits that old
// peers may ignore does not raise it.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "firmware/can/frame.hpp"
#include "firmware/can/layout.hpp"
#include "firmware/can/messages/drives.hpp"
#include "firmware/can/messages/lockstep.hpp"
#include "firmware/can/messages/operator.hpp"
#include "firmware/can/messages/team.hpp"
#include "firmware/can/messages/telemetry.hpp"
#include "firmware/can/messages/vision.hpp"

namespace striker::can {

inline constexpr std::int32_t protocol_version = 4;

using Messages = std::tuple<EmergencyStop, FaultReport, Sync, ModeCommand, WheelCommand, WheelState,
                            VisionPose, VisionBall, WheelOrder, MotionOrder, Challenge, Status, Safety,
                            Decision, Timing, Heartbeat, Version, EndOfTick>;

// Calls visit(layout) for every message, in the order of the table.
template <class Visit>
constexpr void for_each_layout(Visit visit) {
  [&]<class... Message>(const std::tuple<Message...>*) {
    (visit(layout<Message>), ...);
  }(static_cast<const Messages*>(nullptr));
}

// Whether it holds of any message's layout; asks no further then.
template <class Predicate>
[[nodiscard]] constexpr bool any_layout(Predicate holds) {
  return [&]<class... Message>(const std::tuple<Message...>*) {
    return (holds(layout<Message>) || ...);
  }(static_cast<const Messages*>(nullptr));
}

template <class Message>
[[nodiscard]] constexpr bool is(const Frame& frame) {
  return frame.id == layout<Message>.info.id;
}

// How many messages this node sends.
[[nodiscard]] constexpr std::size_t messages_from(Node node) {
  std::size_t count = 0;
  for_each_layout([&](const auto& message) { count += message.info.sender == node ? 1 : 0; });
  return count;
}

namespace detail {

// Identifiers rise along the table: they are unique, and the table reads in the order of priority.
constexpr bool identifiers_rise() {
  int previous = -1;
  bool rising = true;
  for_each_layout([&](const auto& message) {
    rising = rising && message.info.id > previous;
    previous = message.info.id;
  });
  return rising;
}

constexpr bool names_and_data_ids_are_unique() {
  bool unique = true;
  for_each_layout([&](const auto& one) {
    for_each_layout([&](const auto& other) {
      const bool same = one.info.id == other.info.id;
      const bool clash = one.info.name == other.info.name ||
                         (one.info.data_ids != unprotected && one.info.data_ids == other.info.data_ids);
      unique = unique && (same || !clash);
    });
  });
  return unique;
}

template <class... Message>
constexpr bool layouts_are_sound(const std::tuple<Message...>*) {
  return (layout_is_sound<Message>() && ...);
}

static_assert(layouts_are_sound(static_cast<const Messages*>(nullptr)), "a signal overlaps, or does not fit");
static_assert(identifiers_rise(), "identifiers must be unique and rise along the table");
static_assert(names_and_data_ids_are_unique(), "message names and E2E data IDs must be unique");

}  // namespace detail

}  // namespace striker::can

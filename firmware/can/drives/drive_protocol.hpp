// SPDX-License-Identifier: Apache-2.0
// What a wheel drive is spoken to with: from a drive command to frames, and from frames to wheel speeds.
//
// A protocol is an object, as its counters and node identifiers are state. It knows no controller. A drive of
// another make is another type with these members: receive filters and whitelist follow from it.
//
//   sends                    identifiers of the frames that `put` makes, one each at most
//   receives                 identifiers of the frames that `take` wants
//   owns(frame)              is this frame from the drives? No check but the identifier's
//   take(frame, tick, speeds)  checks it; accepted, `speeds` are what was measured
//   put(command, frames)     adds the frames that make the drives do it; called once a tick
//
// The receive order of checks is the codec's (codec.hpp), as far as the protocol has them. A drive has to stop
// by itself when commands stop: its own time-out is a part of choosing one.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

#include "firmware/can/codec.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/core/actions.hpp"
#include "firmware/core/percepts.hpp"

namespace striker::can {

template <class Drives>
concept DriveProtocol = requires(Drives& drives, const Frame& frame, std::uint32_t tick,
                                 core::WheelSpeeds& speeds, const core::DriveCommand& command,
                                 FrameList& frames) {
  { Drives::sends.size() } -> std::convertible_to<std::size_t>;
  { Drives::receives.size() } -> std::convertible_to<std::size_t>;
  { Drives::owns(frame) } -> std::same_as<bool>;
  { drives.take(frame, tick, speeds) } -> std::same_as<Verdict>;
  { drives.put(command, frames) } -> std::same_as<void>;
};

}  // namespace striker::can

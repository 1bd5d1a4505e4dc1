// SPDX-License-Identifier: Apache-2.0
// What a wheel drive is spoken to with: from a drive command to frames, and from frames to wheel speeds.
//
// A protocol is an object, as its counters and node identifiers are state. It knows no controller. A drive of
// another make is another type with these members: receive filters and whitelist follow from it.
//
//   sends                    identifiers of the frames that `put` makes, one each at most
//   receives                 identifiers of the frames that `take` wants
//   owns(frame)              is this frame from the drives? No check but the identifier's
//   take(frame, tick, report)  checks it, by itself and as a sequence; accepted, `report` is what was measured.
//                            `tick` is now, the frame came `frame.age_ms` earlier
//   invalid()                frames come, and are not to be believed any more
//   put(command, frames)     adds the frames that make the drives do it; called once a tick
//
// And for the command gate, which sees frames alone (firmware/safety/command_gate.hpp):
//
//   sequence(frame)          of a frame that it owns: its sequence number, 0 to 15, if its protection is correct
//   command_of(frame)        of a frame that `put` made: what it makes the drives do
//   recode(frame, command)   makes that frame say `command` instead, as the same one in the sequence
//
// The receive order of checks is the codec's (codec.hpp), as far as the protocol has them. A drive has to stop
// by itself when commands stop: its own time-out is a part of choosing one.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/codec.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/core/actions.hpp"
#include "firmware/core/percepts.hpp"

namespace striker::can {

struct DriveReport {
  core::WheelSpeeds speeds;
  bool cut = false;  // the drives hold the torque at 0 by themselves
};

template <class Drives>
concept DriveProtocol = requires(Drives& drives, const Frame& frame, std::uint32_t tick, Frame& changed,
                                 DriveReport& report, const core::DriveCommand& command, FrameList& frames) {
  { Drives::sends.size() } -> std::convertible_to<std::size_t>;
  { Drives::receives.size() } -> std::convertible_to<std::size_t>;
  { Drives::owns(frame) } -> std::same_as<bool>;
  { drives.take(frame, tick, report) } -> std::same_as<Verdict>;
  { drives.invalid() } -> std::same_as<bool>;
  { drives.put(command, frames) } -> std::same_as<void>;
  { Drives::sequence(frame) } -> std::same_as<std::optional<std::uint8_t>>;
  { Drives::command_of(frame) } -> std::same_as<core::DriveCommand>;
  { Drives::recode(changed, command) } -> std::same_as<void>;
};

}  // namespace striker::can

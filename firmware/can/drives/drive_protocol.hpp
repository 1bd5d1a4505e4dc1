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
//
// Drives of another make (`ForeignDrives`) have no end-to-end protection, so no sequence, and have to be enabled before
// they give torque. They have instead:
//
//   claims(identifier)       the drives may understand or send it: none of Striker's own messages may have it
//   most_frames              that `put` adds in a tick
//   judge(tick)              faults of the drives, once a tick after its frames: see DrivePair (drive_pair.hpp)
//   enable(wanted)           once a tick before `put`: whether the controller is active
//   news_of(frame)           of a frame that it owns: what it tells, or why it is not believed
//   may_send(frame)          of a frame that `put` made: its identifier, length and values are such as it makes
//   wheel_of(frame)          of one of those with a torque: whose; nothing for others
//   enables(frame)           it lets a drive give torque
//   disable(frame)           makes it one that does not, with torque 0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/codec.hpp"
#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/core/actions.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/state.hpp"

namespace striker::can {

struct DriveReport {
  core::WheelSpeeds speeds;
  bool cut = false;      // the drives hold the torque at 0 by themselves
  bool is_whole = true;  // both wheels' speeds are there; false: the other wheel's has yet to come
};

// What one frame of a drive of another make tells, by itself.
struct DriveNews {
  Verdict verdict = Verdict::accepted;
  std::size_t wheel = 0;
  std::optional<std::int32_t> speed_mm_s = {};  // of the rim
  std::optional<bool> is_enabled = {};          // it follows torque commands, and has no error
  bool rests = false;                           // with `is_enabled`: it would follow no torque command
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
  { Drives::command_of(frame) } -> std::same_as<core::DriveCommand>;
  { Drives::recode(changed, command) } -> std::same_as<void>;
};

template <class Drives>
concept ForeignDrives = DriveProtocol<Drives> &&
    requires(Drives& drives, const Frame& frame, Frame& changed, std::uint32_t tick, bool wanted,
             std::uint16_t identifier) {
  { Drives::claims(identifier) } -> std::same_as<bool>;
  { Drives::most_frames } -> std::convertible_to<std::size_t>;
  { drives.judge(tick) } -> std::same_as<core::Faults>;
  { drives.enable(wanted) } -> std::same_as<void>;
  { Drives::news_of(frame) } -> std::same_as<DriveNews>;
  { Drives::may_send(frame) } -> std::same_as<bool>;
  { Drives::wheel_of(frame) } -> std::same_as<std::optional<std::size_t>>;
  { Drives::enables(frame) } -> std::same_as<bool>;
  { Drives::disable(changed) } -> std::same_as<void>;
};

template <class Drives>
concept ProtectedDrives = DriveProtocol<Drives> && requires(const Frame& frame) {
  { Drives::sequence(frame) } -> std::same_as<std::optional<std::uint8_t>>;
};

// None of Striker's own messages comes under an identifier of the drives.
template <DriveProtocol Drives>
[[nodiscard]] constexpr bool shares_no_identifier() {
  if constexpr (ForeignDrives<Drives>) {
    return !any_layout([](const auto& message) { return Drives::claims(message.info.id); });
  } else {
    return true;
  }
}

// Of `put`, in a tick.
template <DriveProtocol Drives>
[[nodiscard]] constexpr std::size_t most_drive_frames() {
  if constexpr (ForeignDrives<Drives>) {
    return Drives::most_frames;
  } else {
    return Drives::sends.size();
  }
}

}  // namespace striker::can

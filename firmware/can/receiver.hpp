// SPDX-License-Identifier: Apache-2.0
// The controller's receive side: every frame is checked, then taken whole or ignored whole and counted, and
// what was taken is returned as percepts.
//
//   Receiver receiver;
//   StrikerDrives drives;
//   const core::Percepts percepts = receiver.take(frames, tick, drives);
//
// A team's orders of either kind are one sequence. An operator's frames count one by one, whatever their counter;
// everything else is believed as a sequence (e2e_state.hpp). What only a controller sends, on a bus that does not echo,
// comes from a second one. Other identifiers are none of its business. Cost: a CRC over up to 8 bytes for each frame
// that is meant for the controller.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/message_receiver.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/core/percepts.hpp"

namespace striker::can {

// Frames ignored since boot, by reason. Each stays at 255.
struct IgnoredFrames {
  std::int32_t wrong_length = 0;
  std::int32_t wrong_crc = 0;
  std::int32_t wrong_counter = 0;
  std::int32_t out_of_range = 0;

  void count(Verdict verdict);
};

class Receiver {
 public:
  // This tick's frames, in the order of their reception. A disarm drops the sightings before it.
  template <DriveProtocol Drives>
  [[nodiscard]] core::Percepts take(std::span<const Frame> frames, std::uint32_t tick, Drives& drives) {
    core::Percepts percepts;
    for (const Frame& frame : frames) {
      if (Drives::owns(frame)) {
        take_drives(frame, tick, drives, percepts);
      } else if (std::find(Drives::sends.begin(), Drives::sends.end(), frame.id) != Drives::sends.end()) {
        percepts.second_controller = true;
      } else {
        take_frame(frame, tick, percepts);
      }
    }
    return percepts;
  }

  [[nodiscard]] const IgnoredFrames& ignored() const { return ignored_; }

 private:
  template <DriveProtocol Drives>
  void take_drives(const Frame& frame, std::uint32_t tick, Drives& drives, core::Percepts& percepts) {
    DriveReport report;
    if (accepted(drives.take(frame, tick, report)) && report.is_whole) {
      percepts.wheels = report.speeds;
      percepts.wheels_age_ticks = frame.age_ms;
      percepts.drives_cut = report.cut;
    }
    percepts.invalid.wheels = drives.invalid();
  }
  void take_order(const Frame& frame, std::uint32_t tick, core::Percepts& percepts);
  void take_frame(const Frame& frame, std::uint32_t tick, core::Percepts& percepts);
  bool operators(Verdict verdict, core::Percepts& percepts);
  bool accepted(Verdict verdict) {
    ignored_.count(verdict);
    return verdict == Verdict::accepted;
  }

  MessageReceiver<VisionPose> pose_;
  MessageReceiver<VisionBall> ball_;
  FrameSequence orders_;  // of both of the team's messages
  // Of mode commands: a renewal alone asks for nothing that is safe, and one that is repeated for ever renews nothing.
  E2eMachine<slow_window> operator_order_;
  IgnoredFrames ignored_;
};

}  // namespace striker::can

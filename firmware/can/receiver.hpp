// SPDX-License-Identifier: Apache-2.0
// The controller's receive side: every frame is checked, then taken whole or ignored whole and counted, and
// what was taken is returned as percepts.
//
//   Receiver receiver;
//   StrikerDrives drives;
//   const core::Percepts percepts = receiver.take(frames, tick, drives);
//
// Other identifiers are none of its business. Cost: a CRC over up to 8 bytes for each frame that is meant for
// the controller.
#pragma once

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
        core::WheelSpeeds speeds;
        if (accepted(drives.take(frame, tick, speeds))) {
          percepts.wheels = speeds;
        }
      } else {
        take_frame(frame, tick, percepts);
      }
    }
    return percepts;
  }

  [[nodiscard]] const IgnoredFrames& ignored() const { return ignored_; }

 private:
  void take_frame(const Frame& frame, std::uint32_t tick, core::Percepts& percepts);
  bool accepted(Verdict verdict) {
    ignored_.count(verdict);
    return verdict == Verdict::accepted;
  }

  MessageReceiver<EmergencyStop> stop_;
  MessageReceiver<ModeCommand> mode_;
  MessageReceiver<VisionPose> pose_;
  MessageReceiver<VisionBall> ball_;
  IgnoredFrames ignored_;
};

}  // namespace striker::can

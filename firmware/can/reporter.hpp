// SPDX-License-Identifier: Apache-2.0
// The controller's send side but for the drives: frames of what it says, each when it is due.
//
// In the order of sending: Challenge in the tick of a request; Decision in the tick that made one, or, where a late picture
// may make it again, in the tick of that or when its time is over: each number goes out once; FaultReport at
// a fault and every 100 ms while it is latched; Status at a change and every 10 ms; Safety at a change of the faults
// and every 100 ms; Timing and Heartbeat every 100 ms; Version every second.
// The periods are the message table's.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/codec.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/can/receiver.hpp"
#include "firmware/core/actions.hpp"

namespace striker::can {

// When something is to be sent again.
class SendSchedule {
 public:
  [[nodiscard]] bool due(std::uint32_t tick, std::uint32_t period_ticks) const {
    return !ever_ || tick - last_tick_ >= period_ticks;
  }
  void sent(std::uint32_t tick) {
    ever_ = true;
    last_tick_ = tick;
  }

 private:
  bool ever_ = false;
  std::uint32_t last_tick_ = 0;
};

// What the port tells beside what the controller does.
struct PortReport {
  Timing timing;
  std::uint32_t limits = 0;       // limit_...: what the gate held back in the last tick
  std::uint32_t blocked = 0;      // commands that it stopped since boot
  std::uint32_t lost_frames = 0;  // since boot
  bool repeat_fault = false;      // a latched fault is told again, whatever logical time says
};

class Reporter {
 public:
  // One of each at most, in a tick.
  static constexpr std::size_t most_frames = 8;
  static_assert(most_frames + 2 == messages_from(Node::controller), "all but WheelCommand and EndOfTick");

  void report(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
              const PortReport& port, std::uint32_t policy_identity, FrameList& frames);

 private:
  void report_decision(std::uint32_t tick, const core::Actions& actions, FrameList& frames);
  void report_fault(std::uint32_t tick, const core::Actions& actions, FrameList& frames);
  void report_status(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
                     FrameList& frames);

  void report_safety(std::uint32_t tick, const core::Actions& actions, const PortReport& port,
                     FrameList& frames);

  std::optional<core::Decision> untold_;
  std::uint32_t untold_tick_ = 0;  // that made it
  core::State told_state_ = core::State::boot;
  core::Fault told_fault_ = core::Fault::none;
  core::Faults told_faults_ = 0;
  SendSchedule fault_report_;
  SendSchedule status_;
  SendSchedule safety_;
  SendSchedule timing_;
  SendSchedule heartbeat_;
  SendSchedule version_;
  SendCounter fault_report_counter_;
  SendCounter status_counter_;
  SendCounter safety_counter_;
  SendCounter challenge_counter_;
};

}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// The controller's send side but for the drives: frames of what it says, each when it is due.
//
// In the order of sending: Decision in the tick that made one; FaultReport at a fault and every 100 ms while
// it is latched; Status at a change and every 10 ms; Timing and Heartbeat every 100 ms; Version every second.
// The periods are the message table's.
#pragma once

#include <cstdint>

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

class Reporter {
 public:
  // One of each at most, in a tick.
  static constexpr std::size_t most_frames = 6;
  static_assert(most_frames + 2 == messages_from(Node::controller), "all but WheelCommand and EndOfTick");

  void report(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
              const Timing& timing, std::uint32_t policy_identity, FrameList& frames);

 private:
  void report_fault(std::uint32_t tick, const core::Actions& actions, FrameList& frames);
  void report_status(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
                     FrameList& frames);

  core::State told_state_ = core::State::boot;
  core::Fault told_fault_ = core::Fault::none;
  SendSchedule fault_report_;
  SendSchedule status_;
  SendSchedule timing_;
  SendSchedule heartbeat_;
  SendSchedule version_;
  SendCounter fault_report_counter_;
  SendCounter status_counter_;
};

}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// Striker's own wheel drives: one protected torque command a tick, one protected wheel state back
// (messages/drives.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/message_receiver.hpp"
#include "firmware/can/messages.hpp"

namespace striker::can {

class StrikerDrives {
 public:
  static constexpr std::array<std::uint16_t, 1> sends = {layout<WheelCommand>.info.id};
  static constexpr std::array<std::uint16_t, 1> receives = {layout<WheelState>.info.id};

  [[nodiscard]] static bool owns(const Frame& frame) { return is<WheelState>(frame); }

  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, core::WheelSpeeds& speeds) {
    WheelState state;
    const Verdict verdict = state_.take(frame, tick, state);
    if (verdict == Verdict::accepted) {
      speeds = {state.left_mm_s, state.right_mm_s};
    }
    return verdict;
  }

  void put(const core::DriveCommand& command, FrameList& frames) {
    frames.add(send(WheelCommand{.left_torque_mNm = command.torque.left_mNm,
                                 .right_torque_mNm = command.torque.right_mNm,
                                 .left_set_point_2mm_s = command.set_point.left_mm_s / 2,
                                 .right_set_point_2mm_s = command.set_point.right_mm_s / 2},
                    counter_));
  }

 private:
  MessageReceiver<WheelState> state_;
  SendCounter counter_;
};

static_assert(DriveProtocol<StrikerDrives>);

}  // namespace striker::can

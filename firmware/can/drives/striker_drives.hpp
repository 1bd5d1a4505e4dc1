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

  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, DriveReport& report) {
    WheelState state;
    const Verdict verdict = state_.take(frame, tick, state);
    if (verdict == Verdict::accepted) {
      report = {{state.left_mm_s, state.right_mm_s}, state.torque_cut != 0};
    }
    return verdict;
  }
  [[nodiscard]] bool invalid() const { return state_.invalid(); }

  void put(const core::DriveCommand& command, FrameList& frames) {
    frames.add(send(message(command), counter_));
  }

  [[nodiscard]] static std::optional<std::uint8_t> sequence(const Frame& frame) {
    constexpr const MessageInfo& info = layout<WheelState>.info;
    return sound_counter(frame, info.length, info.data_ids);
  }
  // What is out of range moves nothing: no drive accepts it.
  [[nodiscard]] static core::DriveCommand command_of(const Frame& frame) {
    WheelCommand command;
    if (unpack(frame, command) != Verdict::accepted) {
      return {};
    }
    return {.torque = {command.left_torque_mNm, command.right_torque_mNm},
            .set_point = {2 * command.left_set_point_2mm_s, 2 * command.right_set_point_2mm_s}};
  }
  static void recode(Frame& frame, const core::DriveCommand& command) {
    const std::uint8_t counter = counter_of(frame);
    frame = pack(message(command));
    protect(frame, layout<WheelCommand>.info.data_ids, counter);
  }

 private:
  static constexpr WheelCommand message(const core::DriveCommand& command) {
    return {.left_torque_mNm = command.torque.left_mNm,
            .right_torque_mNm = command.torque.right_mNm,
            .left_set_point_2mm_s = command.set_point.left_mm_s / 2,
            .right_set_point_2mm_s = command.set_point.right_mm_s / 2};
  }

  MessageReceiver<WheelState> state_;
  SendCounter counter_;
};

static_assert(DriveProtocol<StrikerDrives>);

}  // namespace striker::can

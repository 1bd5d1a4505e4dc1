// SPDX-License-Identifier: Apache-2.0
// The drives of Striker's own message table: WheelCommand in, WheelState out, both wheels in one frame. Commands
// are believed as a sequence (firmware/can/e2e_state.hpp): one that is repeated drives nothing, and where two senders
// contradict each other the torque is cut at once.
#pragma once

#include "firmware/can/message_receiver.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/core/freshness.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

class StrikerDrives final : public WheelDrives {
 public:
  // Torque is cut when no valid command came for this long (the message table's timeout: 10 ms).
  static constexpr std::uint32_t timeout_ticks = can::layout<can::WheelCommand>.info.timeout_ms;

  void take(const can::Frame& frame, std::uint32_t tick) override;
  [[nodiscard]] bool cut(std::uint32_t tick) const override {
    return receiver_.invalid() || !command_.within(tick, timeout_ticks - 1);
  }
  [[nodiscard]] const WheelOrders& orders() const override { return orders_; }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override;

  // Wheel commands that failed a check.
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  can::MessageReceiver<can::WheelCommand, can::command_window> receiver_;
  can::SendCounter send_counter_;
  WheelOrders orders_;
  core::Freshness command_;  // by when it was received
  std::uint64_t ignored_ = 0;
};

}  // namespace striker::sil

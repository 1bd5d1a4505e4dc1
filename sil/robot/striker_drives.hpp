// SPDX-License-Identifier: Apache-2.0
// The drives of Striker's own message table: WheelCommand in, WheelState out, both wheels in one frame.
#pragma once

#include "firmware/can/codec.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

class StrikerDrives final : public WheelDrives {
 public:
  // Torque is cut when no valid command came for this long (the message table's timeout: 10 ms).
  static constexpr std::uint32_t timeout_ticks = can::layout<can::WheelCommand>.info.timeout_ms;

  void take(const can::Frame& frame, std::uint32_t tick) override;
  [[nodiscard]] bool cut(std::uint32_t tick) const override {
    return !commanded_ || tick - command_tick_ >= timeout_ticks;
  }
  [[nodiscard]] const WheelOrders& orders() const override { return orders_; }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override;

  // Wheel commands that failed a check.
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  can::ReceiveCounter receive_counter_;
  can::SendCounter send_counter_;
  WheelOrders orders_;
  std::uint32_t command_tick_ = 0;
  bool commanded_ = false;
  std::uint64_t ignored_ = 0;
};

}  // namespace striker::sil

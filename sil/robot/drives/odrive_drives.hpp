// SPDX-License-Identifier: Apache-2.0
// Two virtual ODrives (ODrive's manual, "CAN Protocol", firmware 0.6), set up as firmware/can/drives/odrive_drives.hpp
// asks for: encoder estimates every 1 ms, a heartbeat every 10 ms, a watchdog of 10 ms while in closed loop.
//
// Kept of the real one: closed loop takes 2 ms, and is refused while an error is latched; errors stay until Clear_Errors;
// torque is followed in closed loop and torque control alone; the watchdog's time-out is an error. Both send at the same
// time, the right one's heartbeat 5 ms after the left one's.
#pragma once

#include <array>
#include <cstdint>

#include "sil/robot/drives/foreign_drives.hpp"

namespace striker::sil {

class OdriveDrives final : public ForeignDrives {
 public:
  explicit OdriveDrives(const can::DriveWiring& wiring) : wiring_(wiring) {}

  void take(const can::Frame& frame, std::uint32_t tick) override;
  [[nodiscard]] bool cut(std::uint32_t tick) const override;
  [[nodiscard]] const WheelOrders& orders() const override { return orders_; }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override;
  void fail(std::size_t wheel, DriveFailure failure) override;

 private:
  struct Axis {
    std::uint32_t error = 0;
    std::uint8_t state = 1;         // idle
    std::uint32_t starts_tick = 0;  // in closed loop
    bool is_starting = false;
    bool controls_torque = false;
    bool is_gone = false;
    std::uint32_t fed_tick = 0;
    double torque_Nm = 0.0;  // of the motor, as told
    double turns = 0.0;
  };

  void obey(Axis& axis, std::uint32_t command, const can::Frame& frame, std::uint32_t tick);
  void pass_time(Axis& axis, std::uint32_t tick);
  void order();
  [[nodiscard]] can::Frame frame_of(std::size_t wheel, std::uint32_t command, std::uint32_t first,
                                    std::uint32_t second) const;

  can::DriveWiring wiring_;
  std::array<Axis, 2> axes_;
  WheelOrders orders_;
};

}  // namespace striker::sil

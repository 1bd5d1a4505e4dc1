// SPDX-License-Identifier: Apache-2.0
// Two virtual drives of CiA 402 on CANopen, set up as firmware/can/drives/cia402_drives.hpp asks for: RPDO1 as it comes,
// TPDO1 on SYNC, a heartbeat every 10 ms, torque 0 (fault) after 10 ms without an RPDO.
//
// Kept of real ones: pre-operational after power-on until NMT starts them; PDOs in the state operational alone; the speed is
// measured with SYNC; the state machine of the profile, a step an RPDO; a fault until its reset.
#pragma once

#include <array>
#include <cstdint>

#include "sil/robot/drives/foreign_drives.hpp"

namespace striker::sil {

class Cia402Drives final : public ForeignDrives {
 public:
  explicit Cia402Drives(const can::DriveWiring& wiring) : wiring_(wiring) {}

  void take(const can::Frame& frame, std::uint32_t tick) override;
  [[nodiscard]] bool cut(std::uint32_t tick) const override;
  [[nodiscard]] const WheelOrders& orders() const override { return orders_; }
  void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) override;
  void fail(std::size_t wheel, DriveFailure failure) override;

 private:
  enum class State : std::uint16_t {  // as the status word has it
    switch_on_disabled = 0x0250,
    ready_to_switch_on = 0x0231,
    switched_on = 0x0233,
    operation_enabled = 0x1237,
    fault = 0x0218,
  };
  struct Node {
    bool is_operational = false;
    bool is_gone = false;
    State state = State::switch_on_disabled;
    std::uint16_t control_word = 0;
    std::uint16_t last_control_word = 0;
    std::int16_t torque_per_mille = 0;
    std::uint8_t mode = 0;
    std::uint32_t commanded_tick = 0;
    std::int32_t counts_per_s = 0;  // as measured last
    bool has_to_tell = false;       // since a SYNC
    bool has_emergency = false;
  };

  static void obey(Node& node);
  void order();

  can::DriveWiring wiring_;
  std::array<Node, 2> nodes_;
  WheelOrders orders_;
};

}  // namespace striker::sil

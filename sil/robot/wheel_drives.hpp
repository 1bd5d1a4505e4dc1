// The virtual two-wheel motor controller on the bus: checks every wheel command, holds the last valid one,
// and cuts the torque by itself when commands stop.
#pragma once

#include <cstdint>

#include "firmware/can/codec.hpp"
#include "sil/robot/plant.hpp"

namespace striker::sil {

class WheelDrives {
 public:
  // Torque is cut when no valid command came for this long (the message table's timeout: 10 ms).
  static constexpr std::uint32_t timeout_ticks = can::layout<can::WheelCommand>.info.timeout_ms;

  // Frames with other identifiers are not for the drives.
  void take(const can::Frame& frame, std::uint32_t tick);

  [[nodiscard]] bool cut(std::uint32_t tick) const {
    return !commanded_ || tick - command_tick_ >= timeout_ticks;
  }
  [[nodiscard]] const can::WheelCommand& command() const { return command_; }
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

  [[nodiscard]] can::Frame state_frame(const RimSpeeds& speeds, std::uint32_t tick);

 private:
  can::ReceiveCounter receive_counter_;
  can::SendCounter send_counter_;
  can::WheelCommand command_;
  std::uint32_t command_tick_ = 0;
  bool commanded_ = false;
  std::uint64_t ignored_ = 0;  // frames that failed a check
};

}  // namespace striker::sil

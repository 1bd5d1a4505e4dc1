// SPDX-License-Identifier: Apache-2.0
// A robot's virtual motor controllers as nodes on its bus: they check every command frame, hold the last valid
// command, report what they measure, and cut the torque by themselves when commands stop. What the motors make
// of a command is the plant's (sil/robot/plant.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/can/frame.hpp"
#include "sil/robot/plant.hpp"

namespace striker::sil {

class WheelDrives {
 public:
  virtual ~WheelDrives() = default;

  // Frames with other identifiers are not for the drives.
  virtual void take(const can::Frame& frame, std::uint32_t tick) = 0;

  // The drives' watchdog holds the torque at 0: no command yet, or none for too long.
  [[nodiscard]] virtual bool cut(std::uint32_t tick) const = 0;

  // What the last valid command says; before one came, nothing at all: 0.
  [[nodiscard]] virtual const WheelOrders& orders() const = 0;

  // Appends the frames that tell these speeds.
  virtual void report(const RimSpeeds& speeds, std::uint32_t tick, std::vector<can::Frame>& frames) = 0;
};

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Virtual drives of other makes, as their manuals have them: written from those, not from the firmware's side
// (firmware/can/drives/). Torque drives: the set-point of a wheel order stays 0.
#pragma once

#include <cstddef>
#include <memory>

#include "firmware/can/drives/drive_wiring.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

enum class DriveFailure {
  error,     // an error of its own; it gives no torque any more, and says so
  disarmed,  // it gives no torque any more, and says so
  gone,      // it neither says nor does anything, for ever
};

class ForeignDrives : public WheelDrives {
 public:
  // Of the drive of that wheel (can::left_wheel or right_wheel), from now on.
  virtual void fail(std::size_t wheel, DriveFailure failure) = 0;
};

// Of the wiring's kind: Striker's own, ODrives, or drives of CiA 402.
[[nodiscard]] std::unique_ptr<WheelDrives> make_drives(const can::DriveWiring& wiring);
// Of another make; nothing for Striker's own.
[[nodiscard]] std::unique_ptr<ForeignDrives> make_foreign_drives(const can::DriveWiring& wiring);

}  // namespace striker::sil

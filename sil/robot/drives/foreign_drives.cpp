// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/drives/foreign_drives.hpp"

#include "sil/robot/drives/cia402_drives.hpp"
#include "sil/robot/drives/odrive_drives.hpp"
#include "sil/robot/striker_drives.hpp"

namespace striker::sil {

std::unique_ptr<ForeignDrives> make_foreign_drives(const can::DriveWiring& wiring) {
  switch (wiring.kind) {
    case can::DriveKind::odrive:
      return std::make_unique<OdriveDrives>(wiring);
    case can::DriveKind::cia402:
      return std::make_unique<Cia402Drives>(wiring);
    case can::DriveKind::striker:
      break;
  }
  return nullptr;
}

std::unique_ptr<WheelDrives> make_drives(const can::DriveWiring& wiring) {
  if (auto drives = make_foreign_drives(wiring)) {
    return drives;
  }
  return std::make_unique<StrikerDrives>();
}

}  // namespace striker::sil

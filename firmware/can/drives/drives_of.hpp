// SPDX-License-Identifier: Apache-2.0
// The drive protocol that a robot's description asks for.
//
//   using Drives = DrivesOf<wiring>;   // StrikerDrives, OdriveDrives<wiring> or Cia402Drives<wiring>
#pragma once

#include <type_traits>

#include "firmware/can/drives/cia402_drives.hpp"
#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/can/drives/odrive_drives.hpp"
#include "firmware/can/drives/striker_drives.hpp"

namespace striker::can {

namespace detail {

template <DriveWiring wiring>
constexpr auto drives_of() {
  if constexpr (wiring.kind == DriveKind::odrive) {
    return std::type_identity<OdriveDrives<wiring>>{};
  } else if constexpr (wiring.kind == DriveKind::cia402) {
    return std::type_identity<Cia402Drives<wiring>>{};
  } else {
    return std::type_identity<StrikerDrives>{};
  }
}

}  // namespace detail

template <DriveWiring wiring>
using DrivesOf = typename decltype(detail::drives_of<wiring>())::type;

}  // namespace striker::can

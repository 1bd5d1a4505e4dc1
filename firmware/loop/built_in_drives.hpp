// SPDX-License-Identifier: Apache-2.0
// What this build speaks to its wheels with, as its robot's description says (firmware/can/drives/drive_wiring.hpp).
#pragma once

#include "firmware/can/drives/drives_of.hpp"
#include "firmware/loop/built_in_robot.hpp"

namespace striker::loop {

static_assert(can::in_range(built_in_wiring),
              "STRIKER DRIVES: a number of the drives is out of range, or both wheels have one node: striker-robot check "
              "FILE says which");
static_assert(built_in_wiring.identifier_base == can::identifier_base,
              "STRIKER DRIVES: identifier_base is not the one that this file is compiled with (STRIKER_CAN_BASE)");

using BuiltInDrives = can::DrivesOf<built_in_wiring>;

}  // namespace striker::loop

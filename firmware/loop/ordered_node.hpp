// SPDX-License-Identifier: Apache-2.0
// The node of a robot that has no policy and plays by its team's orders alone, with Striker's own drives.
#pragma once

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/core/orders/no_policy.hpp"
#include "firmware/loop/controller_node.hpp"

namespace striker::loop {

using OrderedNode = ControllerNode<core::Controller<core::NoPolicy>, can::StrikerDrives>;

// Compiled once, in ordered_node.cpp.
extern template class ControllerNode<core::Controller<core::NoPolicy>, can::StrikerDrives>;

}  // namespace striker::loop

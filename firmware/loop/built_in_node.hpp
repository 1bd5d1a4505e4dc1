// SPDX-License-Identifier: Apache-2.0
// The node that this build's programs and images run: the built-in policy, for the built-in robot, with the drives that the
// robot's description names.
#pragma once

#include "firmware/core/controller.hpp"
#include "firmware/core/pilot.hpp"
#include "firmware/loop/built_in_robot.hpp"
#include "firmware/loop/controller_node.hpp"
#include "firmware/policy/built_in.hpp"

namespace striker::loop {

using BuiltInPilot = core::Pilot<policy::built_in>;
using BuiltInNode = ControllerNode<core::Controller<BuiltInPilot>, BuiltInDrives>;

static_assert(BuiltInPilot::suits(built_in_robot),
              "STRIKER POLICY: an action goes beyond the robot's top speed");

// Compiled once, in built_in_node.cpp.
extern template class ControllerNode<core::Controller<BuiltInPilot>, BuiltInDrives>;

}  // namespace striker::loop

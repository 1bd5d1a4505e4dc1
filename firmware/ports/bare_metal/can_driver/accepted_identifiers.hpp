// SPDX-License-Identifier: Apache-2.0
// What a CAN controller's filters let through: the identifiers that this image's node listens to.
#pragma once

#include "firmware/can/controller_receives.hpp"
#include "firmware/loop/built_in_node.hpp"

namespace striker::bare_metal {

inline constexpr auto accepted_identifiers = can::controller_receives<loop::BuiltInNode::Drives>;

}  // namespace striker::bare_metal

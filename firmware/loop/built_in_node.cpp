// SPDX-License-Identifier: Apache-2.0
#include "firmware/loop/built_in_node.hpp"

namespace striker::loop {

template class ControllerNode<core::Controller<BuiltInPilot>, BuiltInDrives>;

}  // namespace striker::loop

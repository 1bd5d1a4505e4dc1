// SPDX-License-Identifier: Apache-2.0
#include "firmware/loop/ordered_node.hpp"

namespace striker::loop {

template class ControllerNode<core::Controller<core::NoPolicy>, can::StrikerDrives>;

}  // namespace striker::loop

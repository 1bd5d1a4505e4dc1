// SPDX-License-Identifier: Apache-2.0
// What goes wrong at the controller's own node: its place on the bus (bus_off, error_passive, interface_down), its
// process (stall), and its memory (state_flips; of the policy's weights: weight_flips.hpp).
#pragma once

#include "sil/bus/in_process_link.hpp"
#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

// Nothing for a fault of another place. The link outlives it.
[[nodiscard]] std::unique_ptr<FrameFault> make_node_fault(const TimedFault& fault, const Random& random,
                                                          InProcessLink& controller);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What the main loop needs of a board: a timer and a CAN controller of your own. stand_in.cpp is none.
#pragma once

#include <cstdint>

#include "firmware/can/frame.hpp"

namespace own_port {

// Waits for the next tick of 1 ms, and returns its number. False when the loop shall end: on a board, never.
[[nodiscard]] bool wait_for_tick(std::uint32_t& tick);

// Another number at every start, never 0: from it follows what an operator has to confirm, and no recording of another
// run may fit (firmware/core/supervision/consent.hpp). A random number generator, or the noise of a converter.
[[nodiscard]] std::uint32_t random_number();

// The oldest frame received. False if nothing waits.
[[nodiscard]] bool receive(striker::can::Frame& frame);

// False if the frame could not be handed over.
[[nodiscard]] bool send(const striker::can::Frame& frame);

}  // namespace own_port

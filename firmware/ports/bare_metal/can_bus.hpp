// The seam to a board's CAN controller: a microcontroller with one of its own implements these two. The
// boards that QEMU has bring none but serial ports: slcan_bus.cpp, which they use, speaks slcan over one.
#pragma once

#include "firmware/can/bus_health.hpp"
#include "firmware/can/frame.hpp"

namespace striker::bare_metal {

void start_can();

// Never waits. False if nothing has come.
[[nodiscard]] bool receive_can(can::Frame& frame);

// False if the frame was not taken.
[[nodiscard]] bool try_send_can(const can::Frame& frame);

[[nodiscard]] can::BusHealth can_health();

}  // namespace striker::bare_metal

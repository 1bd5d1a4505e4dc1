// SPDX-License-Identifier: Apache-2.0
// A board's serial port, letter by letter: the three functions that a board with CAN slcan implements (its
// board.cmake says UART file...). 8 data bits, no parity, 1 stop bit, no flow control, 1 Mbaud or more: a
// frame takes up to 22 letters, 220 us at 1 Mbaud, and a tick makes 1 or 2 frames as a rule, at most 8.
//
// Polled from the main loop alone; no interrupts. A port without a receive FIFO loses letters while a step
// runs, and with them frames: good for tests on an emulator, which holds them back, and for a bench.
#pragma once

namespace striker::bare_metal::uart {

// Pins, baud rate; once, and first.
void start();

// The oldest letter received. False, with `letter` as it was, if none waits. Never waits.
[[nodiscard]] bool try_take(char& letter);

// False if the transmitter has no room. Never waits.
[[nodiscard]] bool try_put(char letter);

}  // namespace striker::bare_metal::uart

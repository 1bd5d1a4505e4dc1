// SPDX-License-Identifier: Apache-2.0
// A board's CAN controller: the four functions that a board implements (its board.cmake says CAN file...)
// and that the tick loop calls, and what it relies on. Boards without one say CAN slcan: slcan_bus.cpp,
// over a serial port.
//
// The order of a tick of 1 ms: receive_can until it says false and the tick is over, one step of the
// controller, try_send_can for each frame that it made, can_health.
//
// Bit timing. 1 Mbit/s, classic CAN 2.0A, sample point at 75 % of the bit, synchronisation jump width as
// the second phase segment allows, 4 quanta at most. 75 % is what Linux takes at this bit rate
// (can_calc_bittiming of drivers/net/can/dev, above 800 kbit/s), so that SocketCAN peers sample alike.
// With a 40 MHz clock, for example, 20 quanta of 2 clocks: 1 synchronisation, 14 propagation and phase 1,
// 5 phase 2. Within 0.1 % of the bit rate, from a crystal: an RC oscillator is too coarse.
//
// Acceptance filters. Standard data frames with the identifiers of firmware/can/controller_receives.hpp,
// which is the only list. Extended and remote frames never pass: can::Frame cannot
// tell them apart. The controller's receive checks ignore what it does not know, so a filter only saves
// time and room; without one, all standard data frames may pass.
//
// Reception while a step runs. Nobody calls receive_can from the start of a step until its frames are
// sent, at most one tick where the step is as short as it has to be. A full bus brings 21 of the shortest
// frames in that time (47 bits each, intermission included), and 9 of 8 data bytes; Striker's own drives,
// camera and operator bring 5. So: room for 24 frames, in the controller's FIFO or in RAM that its
// interrupt fills; the three mailboxes of a bxCAN FIFO alone are too few. Frames come out in the order of
// reception. What finds no room is dropped, the newest first; the frames' counters show the receiver that
// one is missing.
//
// Transmission. The lowest identifier first, as the bus arbitrates, or a status frame holds back a wheel
// command: that is what striker-bus-budget reckons with. Frames of one identifier keep the order of the
// calls, or their counters look like a loss. A tick makes 1 or 2 frames as a rule, and at most 9. A frame
// that has not gone after 10 ms is taken back (the wheel command's timeout: the drives have cut the
// torque), and at bus-off all are: a command that waits for a cable must not move a wheel when that is
// plugged in.
//
// Recovery. On bus_off the driver recovers by itself, as ISO 11898-1 has it: after 128 times 11 recessive
// bits, 1.4 ms at least, it is active again. The loop latches the fault bus_off when it sees one; only an
// operator's clear gives torque again. can_health must show a bus-off for one tick at least, even if it is
// over by then.
//
// Interrupts and threads. All four are called from the main loop alone, never from an interrupt. A driver
// that polls needs no interrupt. One that takes some protects what it shares with them, keeps them below 5
// us, and has them listed as HANDLERS in board.cmake (every other interrupt ends in a fault); stack_usage.py
// reads the vector table, and counts the deepest of them on top of the deepest point.
#pragma once

#include "firmware/can/bus_health.hpp"
#include "firmware/can/frame.hpp"

namespace striker::bare_metal {

// The first call of main: clocks, pins, bit timing, filters; then the controller joins the bus, which
// takes 11 recessive bits. Does not wait for a bus that is not there. The processor may have been reset in
// the middle of a transmission: frames that the controller still holds from before are dropped.
void start_can();

// The oldest frame received. False, with `frame` as it was, if nothing waits. Never waits; a few
// microseconds.
[[nodiscard]] bool receive_can(can::Frame& frame);

// Hands over a frame for transmission. False if there was no room: the frame is dropped, and the loop
// counts it; a later frame of its message follows. Never waits for the bus: without a peer to acknowledge,
// the controller repeats the same frame for ever, and the loop has to go on and fault. A few microseconds,
// or the bound that an implementation states.
[[nodiscard]] bool try_send_can(const can::Frame& frame);

// Asked once a tick.
[[nodiscard]] can::BusHealth can_health();

}  // namespace striker::bare_metal

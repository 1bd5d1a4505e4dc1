// SPDX-License-Identifier: Apache-2.0
// A board's hardware watchdog: the three functions that a board implements (its board.cmake says WATCHDOG
// file...), or says WATCHDOG none: then a hang stays a hang. The drives still cut the torque 10 ms after the
// last command, but nothing starts the controller again.
//
// Fed once a tick, after a completed turn of the loop and never from an interrupt, so that it bites whatever
// keeps the loop from coming round: an endless loop, a clock that stands still, an interrupt that never ends,
// a lockup.
//
// `watchdog_timeout_ms` after the last feed it raises an exception that cannot be masked, where the hardware
// has that (a Cortex-M's NMI), which records where the loop hung; else it resets at once. Where an exception
// came first, the reset follows after as much again, in case the exception does not get there. So the
// processor is reset 20 to 40 ms after the last feed; within 10 to 50 ms is what a board has to keep. Longer
// than the worst turn: a serial port that takes nothing holds slcan up for 16 ms.
//
// The clock should not be the processor's own, where the hardware has another; once started it should not be
// possible to stop it.
#pragma once

#include <cstdint>

namespace striker::bare_metal {

inline constexpr std::uint32_t watchdog_timeout_ms = 20;

// Once, when ticks have begun. The first time-out begins.
void start_watchdog();

// Begins the time-out anew. Less than a microsecond.
void feed_watchdog();

// True in the exception that an expired watchdog has raised; and at start-up, before start_watchdog, after a
// reset by a watchdog that raises none (from the reset's cause, which start_watchdog clears). Before
// memory is prepared: without statics.
[[nodiscard]] bool watchdog_has_expired();

}  // namespace striker::bare_metal

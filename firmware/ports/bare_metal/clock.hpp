// SPDX-License-Identifier: Apache-2.0
// A board's timer: the three functions that a board implements (its board.cmake says CLOCK file...) and
// that the tick loop calls. 1 ms ticks, and the time within one.
//
// The ticks are the controller's time: the wheel loops' period, every watchdog, and the freshness of every
// message are counted in them, so 1 ms has to be 1 ms within 0.1 %, from a crystal. Drift against other
// nodes' clocks does no harm: decisions follow the pictures as they come.
//
// Ticks count on while a step runs over them, by an interrupt of the highest priority (its handler is
// called tick_interrupt; stack_usage.py counts the deepest handler's stack on top of the deepest point) or by a counter that
// runs freely: the loop sees from the difference how many it has missed. Called from the main loop alone.
#pragma once

#include <cstdint>

namespace striker::bare_metal {

// Once, after start_can and before the other two: tick 0 begins.
void start_ticks();

// Whole ticks since the start. Wraps after 49 days, from 2^32 - 1 to 0: only differences mean anything.
// Polled in a loop; less than a microsecond.
[[nodiscard]] std::uint32_t ticks();

// Microseconds since the last tick began, 0 to 999, or more where nobody has asked for `ticks` since. Good
// for what the timing frame tells, not for control.
[[nodiscard]] std::uint32_t since_tick_us();

}  // namespace striker::bare_metal

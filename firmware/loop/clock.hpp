// SPDX-License-Identifier: Apache-2.0
// The clock as the loop sees it: absolute deadlines, one a tick.
//
// Time is a signed integer of the port's choice: nanoseconds in 64 bits on Linux, microseconds in 32 bits on
// a microcontroller, where a 64-bit division would be a call. A port implements it as a plain class:
//
//   Time                    the type
//   wait(idle)              returns at the next deadline, and calls `idle` meanwhile where it has to poll. A
//                           wake-up that is late by whole ticks skips them: the deadlines stay on their grid
//   now()                   the time now; only differences count, and they may wrap
//   to_us(time)             a difference in microseconds
#pragma once

#include <concepts>
#include <cstdint>

namespace striker::loop {

template <class Time>
struct Wake {
  std::uint32_t tick = 0;    // ticks since the start; skipped ones count
  std::uint32_t missed = 0;  // whole ticks that were skipped
  Time lateness = 0;         // after the deadline that was waited for
};

template <class C>
concept Clock = requires(C& clock, typename C::Time time, void (*idle)()) {
  requires std::signed_integral<typename C::Time>;
  { clock.wait(idle) } -> std::same_as<Wake<typename C::Time>>;
  { clock.now() } -> std::same_as<typename C::Time>;
  { C::to_us(time) } -> std::same_as<std::int32_t>;
};

}  // namespace striker::loop

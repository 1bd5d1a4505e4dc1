// SPDX-License-Identifier: Apache-2.0
// The board's timer as the loop's clock: microseconds in 32 bits, which wrap after 71 minutes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/core/tick.hpp"
#include "firmware/loop/clock.hpp"
#include "firmware/ports/bare_metal/clock.hpp"

namespace striker::bare_metal {

class BoardClock {
 public:
  using Time = std::int32_t;  // us

  template <class Idle>
  loop::Wake<Time> wait(Idle idle) {
    while (ticks() == tick_) {
      idle();
    }
    const std::uint32_t now_tick = ticks();
    const std::uint32_t missed = now_tick - tick_ - 1;
    tick_ = now_tick;
    return {
        .tick = tick_,
        .missed = missed,
        .lateness = static_cast<Time>(std::min(missed, greatest_late_ticks)) * core::tick_us + within_tick()};
  }

  // A tick that begins between the two readings would put the time a tick back: then they are read again. Apart, as that
  // bounds it (tools/step_bound/facts.toml).
  [[nodiscard, gnu::noinline]] Time now() const {
    for (;;) {
      const std::uint32_t tick = ticks();
      const Time us = within_tick();
      if (ticks() == tick) {
        return static_cast<Time>(tick * static_cast<std::uint32_t>(core::tick_us) +
                                 static_cast<std::uint32_t>(us));
      }
    }
  }

  [[nodiscard]] static std::int32_t to_us(Time us) { return us; }

 private:
  static constexpr std::uint32_t greatest_late_ticks =
      1'000'000;  // in us, with `within_tick`, 32 bits hold it

  static Time within_tick() { return static_cast<Time>(since_tick_us()); }

  std::uint32_t tick_ = 0;
};

}  // namespace striker::bare_metal

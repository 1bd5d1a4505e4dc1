// SPDX-License-Identifier: Apache-2.0
// One tick of the loop: what a source of ticks hands to the controller's node.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/can/frame.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/core/state.hpp"
#include "firmware/core/tick.hpp"

namespace striker::loop {

inline constexpr std::int64_t tick_period_ns = std::int64_t{core::tick_us} * 1000;

struct Tick {
  std::uint32_t number = 0;                 // logical time in ms; jumps forward over ticks that were missed
  std::span<const can::Frame> frames = {};  // received since the last tick, in their order
  can::Timing timing = {};                  // what the port measured; not available by default
  core::Faults port_faults = 0;             // what the port sees now
  bool stop = false;                        // the port stops: disarm, torque 0
  bool repeat_fault = false;                // a latched fault is told again: logical time does not pass
  std::uint32_t lost_frames = 0;            // received and not kept since the last tick
  bool restart = false;                     // logical time begins anew, with a controller as from boot
};

}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// The clock's ticks on a board: the first tells what ended the run before, and a step whose stack was full
// sends nothing.
#pragma once

#include <optional>

#include "firmware/can/frame_list.hpp"
#include "firmware/core/state.hpp"
#include "firmware/loop/clock_ticks.hpp"
#include "firmware/loop/tick.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/memory.hpp"

namespace striker::bare_metal {

class BoardTicks {
 public:
  constexpr BoardTicks(BoardClock& clock, const loop::ClockTicksOptions& options) : ticks_(clock, options) {}

  // Before the first tick: the fault that it has.
  void tell(core::Fault fault) { untold_ = fault; }

  template <loop::Bus<BoardClock::Time> BusType>
  std::optional<loop::Tick> next(BusType& bus) {
    auto tick = ticks_.next(bus);
    if (tick && untold_ != core::Fault::none) {
      tick->port_faults |= core::set_of(untold_);
      untold_ = core::Fault::none;
    }
    return tick;
  }

  void end(const can::FrameList& sent) {
    if (!stack_is_intact()) {
      end_by_fault({.cause = FaultCause::stack_overflow});
    }
    ticks_.end(sent);
  }
  void done() { ticks_.done(); }

 private:
  loop::ClockTicks<BoardClock> ticks_;
  core::Fault untold_ = core::Fault::none;
};

}  // namespace striker::bare_metal

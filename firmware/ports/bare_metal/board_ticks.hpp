// SPDX-License-Identifier: Apache-2.0
// A source of ticks on a board, of the clock's or of SYNC's: the first tick tells what ended the run before, and a step
// whose stack was full sends nothing.
#pragma once

#include <optional>
#include <utility>

#include "firmware/can/frame_list.hpp"
#include "firmware/core/state.hpp"
#include "firmware/loop/tick.hpp"
#include "firmware/ports/bare_metal/fault_record.hpp"
#include "firmware/ports/bare_metal/memory.hpp"

namespace striker::bare_metal {

// What the bus is told of the run before.
[[nodiscard]] inline core::Fault fault_of(const FaultRecord& record) {
  return record.cause == FaultCause::watchdog ? core::Fault::watchdog : core::Fault::processor_exception;
}

// `Ticks`: what loop/tick_loop.hpp calls a source of ticks.
template <class Ticks>
class BoardTicks {
 public:
  explicit constexpr BoardTicks(Ticks ticks) : ticks_(std::move(ticks)) {}

  // Before the first tick: the fault that it has.
  void tell(core::Fault fault) { untold_ = fault; }

  template <class BusType>
  std::optional<loop::Tick> next(BusType& bus) {
    auto tick = ticks_.next(bus);
    if (tick && untold_ != core::Fault::none) {
      tick->port_faults |= core::set_of(untold_);
      untold_ = core::Fault::none;
    }
    return tick;
  }

  void end(can::FrameList& sent) {
    if (!stack_is_intact()) {
      end_by_fault({.cause = FaultCause::stack_overflow});
    }
    ticks_.end(sent);
  }
  void done() { ticks_.done(); }

  [[nodiscard]] Ticks& source() { return ticks_; }

 private:
  Ticks ticks_;
  core::Fault untold_ = core::Fault::none;
};

}  // namespace striker::bare_metal

// Where the controller's answer to a tick ends, in lockstep. This is the only place that knows: the wheel
// command is the last frame of a step, and carries the low bits of its tick.
#pragma once

#include <cstdint>

#include "firmware/can/codec.hpp"

namespace striker::sil {

enum class EndOfTick {
  no,               // the answer goes on
  of_this_tick,     // the answer to the tick is whole
  of_another_tick,  // a late answer to an earlier tick ends here
};

[[nodiscard]] inline EndOfTick end_of_tick(const can::Frame& frame, std::uint32_t tick) {
  if (!can::is<can::WheelCommand>(frame)) {
    return EndOfTick::no;
  }
  can::WheelCommand command;
  const bool valid = can::unpack(frame, command) == can::Verdict::accepted;
  return valid && static_cast<std::uint32_t>(command.tick_low) == (tick & 0xFU) ? EndOfTick::of_this_tick
                                                                                : EndOfTick::of_another_tick;
}

}  // namespace striker::sil

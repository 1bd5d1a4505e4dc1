// The supervisor: one state machine over five states, as a pure function of what this tick brought.
//
//   boot -> self_test -> standby <-> active
//   any -> fault -> (clear) -> standby, or self_test where that had not passed yet
//
// Faults latch, and the first one is kept. Clearing is an edge, and is refused while the cause, or another
// that would latch at once, lasts. Only `active` may drive the wheels.
#pragma once

#include <cstdint>

#include "firmware/can/messages.hpp"

namespace striker::core {

enum class SelfTest : std::uint8_t { running, passed, failed };

// What this tick brought.
struct Conditions {
  SelfTest self_test = SelfTest::running;
  bool arm = false;  // requests: set for the one tick in which a mode command asks
  bool disarm = false;
  bool clear = false;
  bool emergency_stop = false;  // a stop frame came within its hold time
  bool vision_fresh = false;
  bool vision_ready = false;  // fresh, and good for a velocity: arming needs it
  bool wheels_fresh = false;
};

struct Supervisor {
  can::State state = can::State::boot;
  can::Fault fault = can::Fault::none;  // the first since the last clear
};

[[nodiscard]] Supervisor supervise(const Supervisor& now, const Conditions& conditions);

// A fault that is an event, found outside the conditions: by a port or by the command check.
[[nodiscard]] Supervisor latch(const Supervisor& now, can::Fault fault);

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The supervisor: one state machine over five states, as a pure function of what this tick brought.
//
//   boot -> self_test -> standby <-> active
//   any -> fault -> (clear) -> standby, or self_test where that had not passed yet
//
// Faults latch, and the first one is kept. Clearing is an edge, and is refused while the cause, or another
// that would latch at once, lasts. Only `active` may drive the wheels. Of several causes in one tick the most
// urgent is latched: failed self-test, emergency stop, the port's fault, vision, wheels.
#pragma once

#include <cstdint>

#include "firmware/core/percepts.hpp"
#include "firmware/core/state.hpp"

namespace striker::core {

enum class SelfTest : std::uint8_t { running, passed, failed };

// What this tick brought.
struct Conditions {
  SelfTest self_test = SelfTest::running;
  Requests requests;
  bool emergency_stop = false;     // a stop was pressed within its hold time
  Fault port_fault = Fault::none;  // what the port sees now; it lasts as long as the port says so
  bool vision_fresh = false;
  bool vision_ready = false;  // fresh, and good for a velocity: arming needs it
  bool wheels_fresh = false;
};

struct Supervisor {
  State state = State::boot;
  Fault fault = Fault::none;  // the first since the last clear
};

[[nodiscard]] Supervisor supervise(const Supervisor& now, const Conditions& conditions);

// A fault that is an event, found outside the conditions: by the final check of a command.
[[nodiscard]] Supervisor latch(const Supervisor& now, Fault fault);

}  // namespace striker::core

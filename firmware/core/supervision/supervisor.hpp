// SPDX-License-Identifier: Apache-2.0
// The supervisor: one state machine over five states, as a pure function of what this tick brought.
//
//   boot -> self_test -> standby <-> active
//   any -> fault -> (confirmed clear) -> standby, or self_test where that had not passed yet
//
// Faults latch: the first one is kept apart, and every later one beside it, an emergency stop above all. Clearing
// is an edge, and is refused while any cause lasts. Only `active` may drive the wheels. Of several causes in one
// tick the one with the lowest number is the first, missing inputs last: they may follow from another.
#pragma once

#include <cstdint>

#include "firmware/core/percepts.hpp"
#include "firmware/core/state.hpp"

namespace striker::core {

enum class SelfTest : std::uint32_t { running, passed, failed };

// What an operator wants and may: arming and clearing have been confirmed (consent.hpp).
struct Granted {
  bool arm = false;
  bool disarm = false;
  bool clear = false;
};

// What this tick brought.
struct Conditions {
  SelfTest self_test = SelfTest::running;
  Granted granted;
  bool emergency_stop = false;  // a stop was pressed within its hold time
  Faults causes = 0;            // of faults that this tick shows, beside those below
  bool vision_fresh = false;
  bool vision_ready = false;  // fresh, and good for a velocity: arming needs it
  bool wheels_fresh = false;
};

// Without padding: it is sealed.
struct Supervisor {
  State state = State::boot;
  Fault fault = Fault::none;  // the first since the last clear
  std::uint16_t reserved = 0;
  Faults faults = 0;  // all since the last clear

  bool operator==(const Supervisor&) const = default;
};

// Of these there is no clear: only a reboot.
inline constexpr Faults lasting_faults =
    set_of(Fault::self_test_failed) | set_of(Fault::state_corrupt) | set_of(Fault::policy_corrupt);

[[nodiscard]] Supervisor supervise(const Supervisor& now, const Conditions& conditions);

// Faults that are events, found outside the conditions: by the final check of a command.
[[nodiscard]] Supervisor latch(const Supervisor& now, Faults faults);

}  // namespace striker::core

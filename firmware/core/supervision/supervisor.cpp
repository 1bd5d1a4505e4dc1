// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/supervision/supervisor.hpp"

namespace striker::core {

namespace {

// What this tick shows to be wrong in this state.
Faults causes_in(State state, const Conditions& conditions) {
  // A disarm takes the torque anyway, and makes the vision stale by itself.
  const bool needs_inputs = state == State::active && !conditions.granted.disarm;
  return conditions.causes | set_if(conditions.self_test == SelfTest::failed, Fault::self_test_failed) |
         set_if(conditions.emergency_stop, Fault::emergency_stop) |
         set_if(needs_inputs && !conditions.vision_fresh, Fault::vision_lost) |
         set_if(needs_inputs && !conditions.wheels_fresh, Fault::wheel_state_lost);
}

// A clear would forget what is still wrong. A cause of this tick has been latched before this is asked.
bool cause_lasts(Faults latched, const Conditions& conditions) {
  const Faults missing = set_if(!conditions.vision_fresh, Fault::vision_lost) |
                         set_if(!conditions.wheels_fresh, Fault::wheel_state_lost);
  return (latched & (missing | lasting_faults)) != 0;
}

// That inputs are missing may follow from something else, which is named then.
Fault first_of(Faults faults) {
  constexpr Faults consequences = set_of(Fault::vision_lost) | set_of(Fault::wheel_state_lost);
  faults = (faults & ~consequences) != 0 ? faults & ~consequences : faults;
  for (unsigned code = 1; code < fault_names.size(); ++code) {
    if ((faults >> code & 1U) != 0) {
      return static_cast<Fault>(code);
    }
  }
  return Fault::none;
}

State without_fault(const Supervisor& now, const Conditions& conditions) {
  const State tested = conditions.self_test == SelfTest::passed ? State::standby : State::self_test;
  const Granted& granted = conditions.granted;
  switch (now.state) {
    case State::boot:
      return State::self_test;
    case State::standby:
      return granted.arm && !granted.disarm && conditions.vision_ready && conditions.wheels_fresh
                 ? State::active
                 : State::standby;
    case State::active:
      return granted.disarm ? State::standby : State::active;
    case State::self_test:
    case State::fault:
      break;
  }
  return tested;
}

}  // namespace

Supervisor supervise(const Supervisor& now, const Conditions& conditions) {
  if (const Faults causes = causes_in(now.state, conditions); causes != 0) {
    return latch(now, causes);
  }
  if (now.state == State::fault && (!conditions.granted.clear || cause_lasts(now.faults, conditions))) {
    return now;
  }
  return {.state = without_fault(now, conditions)};
}

Supervisor latch(const Supervisor& now, Faults faults) {
  const Fault first = now.state == State::fault ? now.fault : first_of(faults);
  return {.state = State::fault, .fault = first, .faults = now.faults | faults};
}

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/supervisor.hpp"

namespace striker::core {

namespace {

// The most urgent cause that this tick shows in this state.
Fault cause_of_fault(State state, const Conditions& conditions) {
  if (conditions.self_test == SelfTest::failed) {
    return Fault::self_test_failed;
  }
  if (conditions.emergency_stop) {
    return Fault::emergency_stop;
  }
  if (conditions.port_fault != Fault::none) {
    return conditions.port_fault;
  }
  // A disarm takes the torque anyway, and makes the vision stale by itself.
  const bool needs_inputs = state == State::active && !conditions.requests.disarm;
  if (needs_inputs && !conditions.vision_fresh) {
    return Fault::vision_lost;
  }
  if (needs_inputs && !conditions.wheels_fresh) {
    return Fault::wheel_state_lost;
  }
  return Fault::none;
}

bool cause_lasts(Fault fault, const Conditions& conditions) {
  switch (fault) {
    case Fault::self_test_failed:
      return true;
    case Fault::emergency_stop:
      return conditions.emergency_stop;
    case Fault::vision_lost:
      return !conditions.vision_fresh;
    case Fault::wheel_state_lost:
      return !conditions.wheels_fresh;
    default:
      return fault == conditions.port_fault;
  }
}

}  // namespace

Supervisor supervise(const Supervisor& now, const Conditions& conditions) {
  const State tested = conditions.self_test == SelfTest::passed ? State::standby : State::self_test;
  if (now.state == State::fault) {
    const bool cleared = conditions.requests.clear && !cause_lasts(now.fault, conditions) &&
                         cause_of_fault(State::standby, conditions) == Fault::none;
    return cleared ? Supervisor{tested, Fault::none} : now;
  }
  const Fault cause = cause_of_fault(now.state, conditions);
  if (cause != Fault::none) {
    return {State::fault, cause};
  }
  switch (now.state) {
    case State::boot:
      return {State::self_test, Fault::none};
    case State::self_test:
      return {tested, Fault::none};
    case State::standby:
      return {conditions.requests.arm && !conditions.requests.disarm && conditions.vision_ready &&
                      conditions.wheels_fresh
                  ? State::active
                  : State::standby,
              Fault::none};
    case State::active:
      return {conditions.requests.disarm ? State::standby : State::active, Fault::none};
    case State::fault:
      break;
  }
  return now;
}

Supervisor latch(const Supervisor& now, Fault fault) {
  return now.state == State::fault ? now : Supervisor{State::fault, fault};
}

}  // namespace striker::core

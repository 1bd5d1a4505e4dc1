// SPDX-License-Identifier: Apache-2.0
// The controller of one robot: one `step` a tick of 1 ms, from what is perceived to what the wheels do.
//
//   sense -> supervise -> every 50 ticks: relative state -> policy -> set-point -> wheel loops -> final check
//
// Integers only, no heap, no clock, no I/O, no statics: all state is in the object, which may be copied (a
// copy goes on alone, with the same answers). One thread at a time. It never fails: what goes wrong becomes
// a latched fault and torque 0. It knows no frames: firmware/can makes percepts of them, and frames of what
// it says; firmware/loop puts the two around it.
//
//   Controller<Pilot<policy::kick>> controller(profile_of(forward));
//   Actions actions;
//   for (;;) {                                     // once a tick
//     controller.step({.tick = now, .percepts = percepts}, actions);
//     drives.set(actions.drive);                   // torque 0 unless actions.state is active
//   }
//
// Ticks are logical and count milliseconds. One that jumps forward is a port that missed periods: what was
// fresh ages by the jump. The same tick twice lets no time pass: a port uses it to hand in a fault or a stop
// between two ticks.
//
// Arming wants state standby, two pictures since the last disarm, and fresh wheel speeds. Disarming, not
// arming, forgets the pictures: so the two that arming waits for give the first decision its velocity, and
// nothing from before the disarm can. A port's stop is a disarm in every respect.
//
// Cost: instructions a step on every core are in firmware/policy/README.md; the longest is one with a
// decision.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/core/actions.hpp"
#include "firmware/core/command_check.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/freshness.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/pilot.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/supervisor.hpp"
#include "firmware/core/wheel_loop.hpp"

namespace striker::core {

// A pressed stop holds this long after its last frame, so that a clear cannot overtake a button that repeats.
inline constexpr std::uint32_t stop_hold_ticks = 200;

struct Inputs {
  std::uint32_t tick = 0;
  Percepts percepts;
  Fault port_fault = Fault::none;  // what the port sees now: overrun, bus_off, sync_lost
  bool stop = false;               // the port stops: to standby, with torque 0
};

template <class PilotType>
class Controller {
 public:
  using Pilot = PilotType;

  explicit constexpr Controller(const RobotProfile& robot) : robot_(robot) {}

  void step(const Inputs& inputs, Actions& actions) {
    tick_ = inputs.tick;
    Requests requests = inputs.percepts.requests;
    requests.disarm = requests.disarm || inputs.stop;
    const bool new_picture = sense(inputs.percepts, requests.disarm);
    const Conditions now = conditions(requests, inputs.port_fault);
    adopt(supervise(supervisor_, now));
    actions.decision = decide(new_picture);
    actions.drive = drive(now);
    report(now, actions);
  }

  [[nodiscard]] State state() const { return supervisor_.state; }
  [[nodiscard]] Fault fault() const { return supervisor_.fault; }
  [[nodiscard]] const PilotType& pilot() const { return pilot_; }
  [[nodiscard]] const RobotProfile& robot() const { return robot_; }

 private:
  // True if a picture was completed.
  bool sense(const Percepts& percepts, bool disarm) {
    if (supervisor_.state == State::boot) {
      boot_tick_ = tick_;
    }
    if (disarm) {
      estimator_.reset();
      vision_ = {};
    }
    if (percepts.emergency_stop) {
      stop_.feed(tick_);
    }
    if (percepts.wheels) {
      wheels_.feed(tick_);
      measured_ = *percepts.wheels;
      estimator_.take(measured_);
    }
    if (percepts.robot) {
      estimator_.take(*percepts.robot);
    }
    if (percepts.ball) {
      estimator_.take(*percepts.ball);
    }
    const bool new_picture = estimator_.end_tick(tick_);
    if (new_picture) {
      vision_.feed(tick_);
    }
    return new_picture;
  }

  Conditions conditions(const Requests& requests, Fault port_fault) {
    const bool vision_fresh = vision_.within(tick_, vision_timeout_ticks);
    return {.self_test = pilot_.test_self(robot_),
            .requests = requests,
            .emergency_stop = stop_.within(tick_, stop_hold_ticks),
            .port_fault = port_fault,
            .vision_fresh = vision_fresh,
            .vision_ready = vision_fresh && estimator_.has_velocity(),
            .wheels_fresh = wheels_.within(tick_, wheel_timeout_ticks)};
  }

  // The only place where a state begins: faults get their stamp, and arming begins anew.
  void adopt(const Supervisor& next) {
    if (next.fault != supervisor_.fault) {
      fault_tick_ = tick_;
    }
    if (next.state == State::active && supervisor_.state != State::active) {
      clock_.restart();
      pilot_.reset();
      loops_.reset();
    }
    supervisor_ = next;
  }

  std::optional<Decision> decide(bool new_picture) {
    if (supervisor_.state != State::active) {
      return std::nullopt;
    }
    const DecisionDue due = clock_.at(tick_, new_picture);
    if (due == DecisionDue::no) {
      return std::nullopt;
    }
    return pilot_.decide(relative_state(estimator_.at(tick_)), due == DecisionDue::extrapolated);
  }

  DriveCommand drive(const Conditions& now) {
    if (supervisor_.state != State::active || !clock_.started()) {
      return {};
    }
    const DriveCommand wanted{.torque = loops_.step(robot_, pilot_.set_point(), measured_),
                              .set_point = pilot_.set_point()};
    const Fault refused = check_command(robot_, wanted,
                                        {.armed = supervisor_.fault == Fault::none,
                                         .vision_fresh = now.vision_fresh,
                                         .wheels_fresh = now.wheels_fresh,
                                         .measured = measured_});
    if (refused == Fault::none) {
      return wanted;
    }
    adopt(latch(supervisor_, refused));
    return {};
  }

  void report(const Conditions& now, Actions& actions) const {
    actions.state = supervisor_.state;
    actions.fault = supervisor_.fault;
    actions.fault_tick = fault_tick_;
    actions.uptime_ticks = tick_ - boot_tick_;
    actions.vision_ready = now.vision_ready;
    actions.wheels_ready = now.wheels_fresh;
  }

  RobotProfile robot_;
  std::uint32_t tick_ = 0;
  std::uint32_t boot_tick_ = 0;
  Supervisor supervisor_;
  std::uint32_t fault_tick_ = 0;

  Estimator estimator_;
  WheelSpeeds measured_;
  Freshness vision_;  // complete pictures
  Freshness wheels_;
  Freshness stop_;

  DecisionClock clock_;
  PilotType pilot_;
  WheelLoops loops_;

  static_assert(std::is_trivially_copyable_v<PilotType>);
};

}  // namespace striker::core

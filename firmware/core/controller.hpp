// SPDX-License-Identifier: Apache-2.0
// The controller of one robot: one `step` a tick of 1 ms, from what is perceived to what the wheels do.
//
//   sense -> supervise -> every 50 ticks: relative state -> policy -> set-point -> wheel loops -> final check
//
// Integers only, no heap, no clock, no I/O, no statics: all state is in the object, which may be copied (a
// copy goes on alone, with the same answers). One thread at a time. It never fails: what goes wrong becomes
// a latched fault and torque 0. It knows no frames: firmware/can makes percepts of them and tells what it says.
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
// between two ticks. A tick that goes back is a fault.
//
// Arming wants state standby, pictures since the last disarm that tell a velocity, fresh wheel speeds, and consent in
// two steps (consent.hpp). It lasts `armed_limit_ticks` and is prolonged by a renewal. Disarming, not arming, forgets the
// pictures: so those that arming waits for give the first decision its velocity, and nothing from before the
// disarm can. A port's stop is a disarm in every respect. Armed, the policy acts, or what a team orders
// (orders/standing_order.hpp).
//
// The state is sealed between two steps (seal.hpp): a bit of it that changes by itself is found before it is used.
// Cost: instructions a step on every core are in firmware/policy/README.md; a decision's step is the longest.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/core/actions.hpp"
#include "firmware/core/decision_clock.hpp"
#include "firmware/core/estimation/command_lead.hpp"
#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/estimation/field_border.hpp"
#include "firmware/core/estimation/plausibility.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/core/orders/standing_order.hpp"
#include "firmware/core/pending_torque.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/pilot.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/seal.hpp"
#include "firmware/core/supervision/command_check.hpp"
#include "firmware/core/supervision/consent.hpp"
#include "firmware/core/supervision/kept_state.hpp"
#include "firmware/core/supervision/supervisor.hpp"
#include "firmware/core/supervision/vigilance.hpp"
#include "firmware/core/wheel_loop.hpp"

namespace striker::core {

// Ticks may jump forward by this much; beyond it, time has gone back.
inline constexpr std::uint32_t greatest_jump_ticks = 0x7FFFFFFF;

// `seed` begins the sequence of challenges; 0 is for simulations (consent.hpp).
template <class PilotType>
class Controller {
 public:
  using Pilot = PilotType;

  explicit constexpr Controller(const RobotProfile& robot, std::uint32_t seed = 0)
      : now_(robot, seed), seal_(seal_of(now_)) {}

  void step(const Inputs& inputs, Actions& actions) {
    memory_is_open_ = false;
    require_sound_state();
    const Conditions conditions = sense(inputs);
    adopt(supervise(now_.supervisor, conditions));
    actions.decision = decide();
    actions.drive = drive(conditions);
    report(conditions, actions);
    if (memory_is_open_) {
      memory_.close();
    }
    if (is_late()) {
      pending_.close();
    }
    seal_ = seal_of(now_);
  }

  // Before the first step, where the seed is known at run time alone.
  void seed_challenges(std::uint32_t seed) {
    now_.consent = Consent(seed);
    seal_ = seal_of(now_);
  }

  // Logical time begins again, with a controller as from boot. A stop that was pressed is kept: only a power cycle
  // forgets it; and so is what only a reboot clears. Memory that changed by itself is found here too.
  void begin_anew() {
    require_sound_state();
    begin_with(now_.supervisor.faults & (lasting_faults | set_of(Fault::emergency_stop)));
  }

  [[nodiscard]] State state() const { return now_.supervisor.state; }
  [[nodiscard]] Fault fault() const { return now_.supervisor.fault; }
  [[nodiscard]] Faults faults() const { return now_.supervisor.faults; }
  [[nodiscard]] const PilotType& pilot() const { return memory_.state.pilot; }

 private:
  using Now = KeptEachTick<PilotType>;
  using Memory = KeptMemory<PilotType>;

  // Commands take time: what is on its way is part of the state. Otherwise it stays empty, and is not looked at.
  [[nodiscard]] bool is_late() const { return now_.robot.command_delay_ticks != 0; }

  void require_sound_state() {
    if (seal_of(now_) != seal_ || (is_late() && !pending_.is_sound())) {
      forget_corrupt_state();
    }
  }

  // Apart, for the stack's sake, as what follows.
  [[gnu::noinline]] void begin_with(Faults faults) {
    *this = Controller(now_.robot, now_.consent.next_seed());
    if (faults != 0) {
      now_.supervisor = latch(now_.supervisor, faults);
      seal_ = seal_of(now_);
    }
  }

  // Nothing of it can be believed, the robot's limits included, but that it has to stand.
  [[gnu::noinline, gnu::cold]] void forget_corrupt_state() {
    const Supervisor corrupt = {
        .state = State::fault,
        .fault = Fault::state_corrupt,
        .faults = (now_.supervisor.faults & known_faults) | set_of(Fault::state_corrupt)};
    const std::uint32_t tick = now_.tick;
    now_ = Now(RobotProfile{}, now_.consent.next_seed());
    now_.tick = now_.boot_tick = now_.fault_tick = tick;
    memory_.state = {};
    memory_is_open_ = true;
    now_.supervisor = corrupt;
  }

  Memory& open_memory() {
    if (!memory_is_open_) {
      memory_is_open_ = true;
      if (!memory_.is_sound()) {
        forget_corrupt_state();
      }
    }
    return memory_.state;
  }

  Conditions sense(const Inputs& inputs) {
    const bool boot = now_.supervisor.state == State::boot;
    const bool went_back = !boot && inputs.tick - now_.tick > greatest_jump_ticks;
    const std::uint32_t elapsed = boot || went_back ? 0 : inputs.tick - now_.tick;
    now_.tick = inputs.tick;
    now_.boot_tick = boot ? inputs.tick : now_.boot_tick;
    test_self();
    const bool disarm = inputs.percepts.requests.disarm || inputs.stop;
    take(inputs.percepts, elapsed, disarm);
    const Order granted = now_.consent.step(now_.tick, inputs.percepts.requests);
    const bool vision_fresh = now_.vigilance.vision_is_fresh();
    const bool stays_active = now_.supervisor.state == State::active && !disarm;
    const Faults causes = now_.vigilance.causes(stays_active) | inputs.port_faults |
                          set_if(!now_.weights.step(), Fault::policy_corrupt) |
                          set_if(went_back, Fault::clock_invalid);
    return {.self_test = now_.self_test,
            .granted = {.arm = granted == Order::arm, .disarm = disarm, .clear = granted == Order::clear},
            .emergency_stop = now_.vigilance.stop_is_pressed(),
            .causes = causes,
            .vision_fresh = vision_fresh,
            .vision_ready = vision_fresh && now_.has_velocity != 0,
            .wheels_fresh = now_.vigilance.wheels_are_fresh()};
  }

  void test_self() {
    if (now_.self_test == SelfTest::running) {
      now_.self_test = open_memory().pilot.test_self(now_.robot);
    }
  }

  void take(const Percepts& percepts, std::uint32_t elapsed, bool disarm) {
    const bool active = now_.supervisor.state == State::active;
    now_.vigilance.begin_tick(now_.tick, elapsed, active, now_.torque != WheelTorques{}, percepts);
    if (disarm) {
      open_memory().estimator.reset();
      now_.vigilance.forget_pictures();
      now_.has_velocity = 0;
    }
    if (percepts.wheels) {
      now_.measured = *percepts.wheels;
      now_.odometry.take(active ? now_.loops.see(now_.robot, now_.measured) : now_.measured);
      if (active && !now_.plausibility.possible(now_.robot, now_.tick, now_.measured, now_.loops.acting())) {
        now_.vigilance.see_impossible_wheels();
      }
    }
    now_.odometry.advance(now_.robot, now_.tick);
    now_.orders.step(now_.robot, now_.tick, percepts, now_.set_point);
    now_.new_picture = 0;
    if (percepts.robot || percepts.ball) {
      take_picture(percepts);
    }
  }

  void take_picture(const Percepts& percepts) {
    Estimator& estimator = open_memory().estimator;
    if (percepts.robot) {
      estimator.take(*percepts.robot, now_.tick);
    }
    if (percepts.ball) {
      estimator.take(*percepts.ball, now_.tick);
    }
    const PictureResult result = estimator.end_tick(now_.robot, now_.odometry);
    now_.vigilance.see_picture(result, estimator.picture_tick(), now_.tick);
    now_.has_velocity = static_cast<std::uint32_t>(estimator.has_velocity());
    now_.new_picture = static_cast<std::uint32_t>(is_new(result));
  }

  // The only place where a state begins: faults get their stamp, and arming begins anew.
  void adopt(const Supervisor& next) {
    if (!(next == now_.supervisor)) {
      change_to(next);
    }
  }

  [[gnu::noinline]] void change_to(const Supervisor& next) {  // few ticks need it
    if (next.fault != now_.supervisor.fault) {
      now_.fault_tick = now_.tick;
    }
    if (next.state == State::active && now_.supervisor.state != State::active) {
      open_memory().pilot.reset();
      if (now_.supervisor.state == State::fault) {
        return;  // the memory was corrupt
      }
      now_.clock.restart();
      now_.loops.reset(now_.measured);
      pending_.state = {};
      now_.plausibility.restart();
      now_.set_point = {};
      now_.kick_over = 0;
      now_.orders = now_.orders.at_arming();
    }
    if (next.state != now_.supervisor.state) {
      now_.consent.close();
    }
    now_.supervisor = next;
  }

  std::optional<Decision> decide() {
    if (now_.supervisor.state != State::active) {
      return std::nullopt;
    }
    if (!now_.orders.lets_policy_act()) {
      now_.kick_over = 0;
      return std::nullopt;
    }
    const bool begins = now_.orders.take_beginning();
    if (begins) {
      now_.clock.make_due(now_.tick);
    }
    const DecisionDue due =
        now_.clock.at(now_.tick, now_.new_picture != 0, decides_on_each_picture(now_.robot));
    if (due == DecisionDue::no) {
      return std::nullopt;
    }
    Memory& memory = open_memory();
    if (now_.supervisor.state != State::active) {
      return std::nullopt;  // the memory was corrupt
    }
    if (begins) {
      memory.pilot.reset();
    }
    const Estimate seen = led_through_delay(now_.robot, memory.estimator.at(now_.tick, now_.odometry),
                                            pending_.state.speed_change_mm_s(now_.robot));
    Decision decision = memory.pilot.decide(relative_state(seen), due, is_late() ? 1 : 0);
    memory.pilot.end_if(leaves_field(now_.robot, seen, memory.pilot.set_point()), decision);
    now_.set_point = memory.pilot.set_point();
    now_.kick_over = static_cast<std::uint32_t>(decision.over);
    return decision;
  }

  DriveCommand drive(const Conditions& conditions) {
    DriveCommand command = {};
    const bool begun = now_.clock.started() || now_.orders.state() != OrderState::none;
    if (now_.supervisor.state == State::active && begun) {
      command = checked({.torque = now_.loops.step(now_.robot, now_.set_point, now_.measured, pending_.state),
                         .set_point = now_.set_point},
                        conditions);
    }
    now_.torque = command.torque;
    return command;
  }

  DriveCommand checked(const DriveCommand& wanted, const Conditions& conditions) {
    const Fault refused = check_command(now_.robot, wanted,
                                        {.armed = now_.supervisor.fault == Fault::none,
                                         .vision_fresh = conditions.vision_fresh,
                                         .wheels_fresh = conditions.wheels_fresh,
                                         .measured = now_.measured});
    if (refused == Fault::none) {
      return wanted;
    }
    adopt(latch(now_.supervisor, set_of(refused)));
    return {};
  }

  void report(const Conditions& conditions, Actions& actions) const {
    actions.state = now_.supervisor.state;
    actions.fault = now_.supervisor.fault;
    actions.faults = now_.supervisor.faults;
    actions.fault_tick = now_.fault_tick;
    actions.uptime_ticks = now_.tick - now_.boot_tick;
    actions.challenge = now_.consent.opened_at(now_.tick);
    actions.vision_ready = conditions.vision_ready;
    actions.wheels_ready = conditions.wheels_fresh;
    const bool active = now_.supervisor.state == State::active;
    actions.kick_over = active && now_.kick_over != 0;
    actions.orders = now_.orders.state();
  }

  Now now_;
  Sealed<Memory> memory_;
  Sealed<PendingTorques> pending_;
  bool memory_is_open_ = false;  // in this step: it was found sound, and will be sealed again
  std::uint32_t seal_;
  static_assert(std::is_trivially_copyable_v<PilotType>);
};

}  // namespace striker::core

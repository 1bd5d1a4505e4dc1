// SPDX-License-Identifier: Apache-2.0
// What holds on every tick of a controller behind its gate, seen from outside: from the frames that went in, the
// frames that came out, and the state that it says it is in.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <span>

#include "firmware/core/supervision/consent.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "tests/fuzz/support/any_frame.hpp"

namespace striker::fuzz {

using GatedController = loop::GatedNode<loop::BuiltInNode>;

struct Told {
  core::State state = core::State::boot;
  core::Fault fault = core::Fault::none;
  core::Faults faults = 0;
  bool operator==(const Told&) const = default;
};

inline Told told_of(const GatedController& node) {
  return {node.controller().state(), node.controller().fault(), node.controller().faults()};
}

class Invariants {
 public:
  void check(const Told& before, const loop::Tick& tick, std::span<const can::Frame> sent,
             const GatedController& node) {
    begin(tick);
    for (const can::Frame& frame : tick.frames) {
      see_received(frame);
    }
    const Told now = told_of(node);
    check_state(now);
    check_change(before, now, tick);
    check_sent(before, now, sent);
    before_tick_ = tick.number;
    begun_ = true;
  }

 private:
  static constexpr std::uint32_t never = 0x7FFFFFFF;

  // What has happened in this tick, and how long ago something last did.
  void begin(const loop::Tick& tick) {
    const bool goes_back = tick.number - before_tick_ > core::greatest_jump_ticks;
    const std::uint32_t elapsed = !begun_ || goes_back ? 0 : tick.number - before_tick_;
    if (tick.restart) {
      wheels_age_ = vision_age_ = order_age_ = challenge_age_ = stop_age_ = never;
      counter_known_ = team_told_ = false;
    }
    for (std::uint32_t* age :
         {&wheels_age_, &vision_age_, &order_age_, &stop_age_, &challenge_age_, &armed_age_}) {
      *age = std::min(*age + std::min(elapsed, never), never);
    }
    arm_confirmed_ = clear_confirmed_ = stopped_ = false;
  }

  void see_received(const can::Frame& frame) {
    can::ModeCommand command;
    if (is_correct<can::WheelState>(frame)) {
      wheels_age_ = std::min<std::uint32_t>(wheels_age_, frame.age_ms);
    } else if (is_correct<can::VisionBall>(frame)) {
      vision_age_ = std::min<std::uint32_t>(vision_age_, frame.age_ms);
    } else if (is_correct<can::WheelOrder>(frame) || is_correct<can::MotionOrder>(frame)) {
      order_age_ = std::min<std::uint32_t>(order_age_, frame.age_ms);
    } else if (is_correct<can::EmergencyStop>(frame)) {
      stopped_ = true;
      stop_age_ = 0;
    } else if (holds(frame, command)) {
      const bool fits = command.challenge != 0 && command.challenge == challenge_.challenge &&
                        command.mode == challenge_.mode && challenge_age_ <= core::consent_ticks;
      arm_confirmed_ = arm_confirmed_ || (fits && command.mode == static_cast<std::int32_t>(can::Mode::arm));
      clear_confirmed_ =
          clear_confirmed_ || (fits && command.mode == static_cast<std::int32_t>(can::Mode::clear));
      if (arm_confirmed_ || command.mode == static_cast<std::int32_t>(can::Mode::renew)) {
        armed_age_ = 0;
      }
    }
  }

  static void check_state(const Told& now) {
    require(now.state <= core::State::fault && now.fault <= core::Fault::watchdog,
            "the state is one of its values");
    require((now.faults & ~core::known_faults) == 0, "every latched fault is a known one");
    require((now.state == core::State::fault) == (now.fault != core::Fault::none),
            "a fault is the state fault");
    require((now.faults & core::set_of(now.fault)) == core::set_of(now.fault),
            "the first fault is among all");
    require((now.fault == core::Fault::none) == (now.faults == 0), "no fault beside none");
  }

  void check_change(const Told& before, const Told& now, const loop::Tick& tick) const {
    constexpr core::Faults kept = core::lasting_faults | core::set_of(core::Fault::emergency_stop);
    const auto stop = core::set_of(core::Fault::emergency_stop);
    require(!stopped_ || (now.faults & stop) != 0, "a stop latches in its own tick");
    require(stop_age_ > 200 || tick.restart || (now.faults & stop) != 0,
            "a stop holds for 200 ticks at least");
    require((now.faults & tick.port_faults) == tick.port_faults,
            "what the port sees is latched in that tick");
    if (tick.restart) {
      require((now.faults & before.faults & kept) == (before.faults & kept), "a restart forgets no stop");
      require(now.state != core::State::active, "nothing is armed after a restart");
      return;
    }
    if (before.state == core::State::fault) {
      if (now.state == core::State::fault) {
        require(now.fault == before.fault || clear_confirmed_, "the first fault stays the first");
        require((now.faults & before.faults) == before.faults || clear_confirmed_, "no fault is forgotten");
      } else {
        require(clear_confirmed_, "a fault is left by a confirmed clear");
        require(now.state != core::State::active, "a clear does not arm");
        require((before.faults & core::lasting_faults) == 0, "some faults last until a reboot");
      }
    } else if (before.state != core::State::active && now.state == core::State::active) {
      require(before.state == core::State::standby && arm_confirmed_,
              "arming is a confirmed step from standby");
    }
  }

  void check_sent(const Told& before, const Told& now, std::span<const can::Frame> sent) {
    require(!sent.empty() && sent.size() <= can::FrameList::capacity, "a tick has frames, and room for them");
    require(can::is<can::WheelCommand>(sent.back()), "the command comes last");
    bool told = false;
    for (const can::Frame& frame : sent) {
      check_report(frame, now);
      told = told || can::is<can::Status>(frame);
      can::Challenge challenge;
      if (holds(frame, challenge)) {
        challenge_ = challenge;
        challenge_age_ = 0;
      }
    }
    const bool changed = before.state != now.state || before.fault != now.fault;
    require(told || !changed, "a change of state is told in its tick");
    check_command(sent.back(), now);
  }

  void check_report(const can::Frame& frame, const Told& now) {
    can::Status status;
    can::FaultReport report;
    can::Safety safety;
    if (can::is<can::Status>(frame)) {
      require(holds(frame, status) && status.state == static_cast<std::int32_t>(now.state) &&
                  status.fault == static_cast<std::int32_t>(now.fault),
              "Status tells what is");
      const auto orders = static_cast<core::OrderState>(status.orders);
      const bool followed = orders == core::OrderState::motion || orders == core::OrderState::wheels;
      require(!team_told_ || orders != core::OrderState::none, "a team that was heard is not forgotten");
      team_told_ = orders != core::OrderState::none;
      require(now.state != core::State::active || !followed || order_age_ <= core::order_timeout_ticks,
              "an order that is followed is good");
    } else if (can::is<can::FaultReport>(frame)) {
      require(holds(frame, report) && report.code == static_cast<std::int32_t>(now.fault),
              "FaultReport tells what is");
    } else if (can::is<can::Safety>(frame)) {
      require(holds(frame, safety) && safety.faults == static_cast<std::int32_t>(now.faults),
              "Safety tells what is");
    }
  }

  void check_command(const can::Frame& frame, const Told& now) {
    can::WheelCommand command;
    require(holds(frame, command), "the command is correct");
    const std::uint8_t counter = can::counter_of(frame);
    require(!counter_known_ || counter == (counter_ + 1) % can::counter_modulus,
            "the command's counter goes on");
    counter_ = counter;
    counter_known_ = true;
    if (moves(frame)) {
      require(now.state == core::State::active, "what moves is armed, and without a fault");
      require(wheels_age_ <= core::wheel_timeout_ticks, "what moves has fresh wheel states");
      require(vision_age_ <= core::vision_timeout_ticks, "what moves has fresh pictures");
      require(armed_age_ <= 10'001, "what moves was armed or renewed within the dead man's time");
    }
    for (const std::int32_t torque_mNm : {command.left_torque_mNm, command.right_torque_mNm}) {
      require(std::abs(torque_mNm) <= loop::built_in_robot.torque_limit_mNm, "no torque beyond the limit");
    }
    for (const std::int32_t set_point_2mm_s : {command.left_set_point_2mm_s, command.right_set_point_2mm_s}) {
      require(2 * std::abs(set_point_2mm_s) <= loop::built_in_robot.top_rim_speed_mm_s,
              "no set-point beyond the limit");
    }
  }

  bool begun_ = false;
  std::uint32_t before_tick_ = 0;
  std::uint32_t wheels_age_ = never;
  std::uint32_t vision_age_ = never;
  std::uint32_t order_age_ = never;
  bool team_told_ = false;
  std::uint32_t stop_age_ = never;
  std::uint32_t armed_age_ = never;
  can::Challenge challenge_;  // the last one that was told
  std::uint32_t challenge_age_ = never;
  bool arm_confirmed_ = false;
  bool clear_confirmed_ = false;
  bool stopped_ = false;
  std::uint8_t counter_ = 0;
  bool counter_known_ = false;
};

}  // namespace striker::fuzz

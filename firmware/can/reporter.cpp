// SPDX-License-Identifier: Apache-2.0
#include "firmware/can/reporter.hpp"

#include "firmware/core/decision_clock.hpp"
#include "firmware/core/tick.hpp"

namespace striker::can {

namespace {

template <class Message>
constexpr std::uint32_t period = layout<Message>.info.period_ms;

constexpr std::int32_t low_31_bits(std::uint32_t value) {
  return static_cast<std::int32_t>(value & 0x7FFFFFFFU);
}

// True when a periodic message is due; then it counts as sent.
bool take_due(SendSchedule& schedule, std::uint32_t tick, std::uint32_t period_ticks) {
  const bool due = schedule.due(tick, period_ticks);
  if (due) {
    schedule.sent(tick);
  }
  return due;
}

Frame decision_frame(const core::Decision& decision) {
  return pack(Decision{.number = static_cast<std::int32_t>(decision.number & 0xFFFFU),
                       .action = decision.action,
                       .extrapolated = static_cast<std::int32_t>(decision.extrapolated),
                       .best_q_256th = decision.best_q_256th,
                       .next_q_256th = decision.next_q_256th});
}

Challenge challenge_of(const core::OpenRequest& request) {
  const Mode mode = request.order == core::Order::arm ? Mode::arm : Mode::clear;
  return {.mode = static_cast<std::int32_t>(mode), .challenge = static_cast<std::int32_t>(request.challenge)};
}

}  // namespace

void Reporter::report(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
                      const PortReport& port, std::uint32_t policy_identity, FrameList& frames) {
  if (actions.challenge.order != core::Order::none) {
    frames.add(send(challenge_of(actions.challenge), challenge_counter_));
  }
  report_decision(tick, actions, frames);
  const bool changed = actions.state != told_state_ || actions.fault != told_fault_;
  const bool faulty = actions.state == core::State::fault;
  if (faulty && (changed || port.repeat_fault || fault_report_.due(tick, period<FaultReport>))) {
    report_fault(tick, actions, frames);
  }
  if (changed || status_.due(tick, period<Status>)) {
    report_status(tick, actions, ignored, frames);
  }
  if (actions.faults != told_faults_ || safety_.due(tick, period<Safety>)) {
    report_safety(tick, actions, port, frames);
  }
  if (take_due(timing_, tick, period<Timing>)) {
    frames.add(pack(port.timing));
  }
  if (take_due(heartbeat_, tick, period<Heartbeat>)) {
    frames.add(pack(Heartbeat{.uptime_ms = low_31_bits(actions.uptime_ticks)}));
  }
  if (take_due(version_, tick, period<Version>)) {
    frames.add(pack(Version{.protocol = protocol_version,
                            .decision_period_ms = core::decision_period_ms,
                            .policy_low = static_cast<std::int32_t>(policy_identity & 0xFFFFU),
                            .policy_high = static_cast<std::int32_t>(policy_identity >> 16U)}));
  }
}

void Reporter::report_decision(std::uint32_t tick, const core::Actions& actions, FrameList& frames) {
  if (actions.decision) {
    untold_ = actions.decision;
    untold_tick_ = tick;
  }
  if (untold_ && (!untold_->provisional || tick - untold_tick_ > core::decision_window_ticks)) {
    frames.add(decision_frame(*untold_));
    untold_.reset();
  }
}

void Reporter::report_fault(std::uint32_t tick, const core::Actions& actions, FrameList& frames) {
  fault_report_.sent(tick);
  frames.add(send(
      FaultReport{.code = static_cast<std::int32_t>(actions.fault), .tick = low_31_bits(actions.fault_tick)},
      fault_report_counter_));
}

void Reporter::report_safety(std::uint32_t tick, const core::Actions& actions, const PortReport& port,
                             FrameList& frames) {
  safety_.sent(tick);
  told_faults_ = actions.faults;
  frames.add(send(Safety{.limits = static_cast<std::int32_t>(port.limits),
                         .faults = static_cast<std::int32_t>(actions.faults),
                         .blocked = static_cast<std::int32_t>(port.blocked),
                         .lost_frames = static_cast<std::int32_t>(port.lost_frames)},
                  safety_counter_));
}

void Reporter::report_status(std::uint32_t tick, const core::Actions& actions, const IgnoredFrames& ignored,
                             FrameList& frames) {
  status_.sent(tick);
  told_state_ = actions.state;
  told_fault_ = actions.fault;
  frames.add(send(Status{.state = static_cast<std::int32_t>(actions.state),
                         .fault = static_cast<std::int32_t>(actions.fault),
                         .wrong_length = ignored.wrong_length,
                         .wrong_crc = ignored.wrong_crc,
                         .wrong_counter = ignored.wrong_counter,
                         .out_of_range = ignored.out_of_range,
                         .vision_ready = static_cast<std::int32_t>(actions.vision_ready),
                         .wheels_ready = static_cast<std::int32_t>(actions.wheels_ready),
                         .kick_over = static_cast<std::int32_t>(actions.kick_over),
                         .orders = static_cast<std::int32_t>(actions.orders)},
                  status_counter_));
}

}  // namespace striker::can

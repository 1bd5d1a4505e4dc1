// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/watch/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "firmware/can/e2e_state.hpp"
#include "firmware/core/state.hpp"
#include "sil/fault/link/recode.hpp"

namespace striker::sil {

namespace {

constexpr std::uint32_t most_commands_after_fault = 2;
constexpr std::uint32_t most_ticks_after_stop = 2;
constexpr std::uint32_t oldest_wheels_ticks = 25;
constexpr std::uint32_t oldest_vision_ticks = 200;
constexpr std::uint32_t oldest_sync_ticks = 25;
constexpr std::uint32_t oldest_command_ticks = can::layout<can::WheelCommand>.info.timeout_ms;
constexpr double fastest_rim = 2.5;  // of the robot's top speed

constexpr std::int32_t fault_state = static_cast<std::int32_t>(core::State::fault);
constexpr std::int32_t active_state = static_cast<std::int32_t>(core::State::active);
constexpr std::int32_t no_fault = static_cast<std::int32_t>(core::Fault::none);
constexpr std::int32_t corrupt = static_cast<std::int32_t>(core::Fault::state_corrupt);
constexpr std::int32_t emergency = static_cast<std::int32_t>(core::Fault::emergency_stop);

bool has_torque(const can::WheelCommand& command) {
  return command.left_torque_mNm != 0 || command.right_torque_mNm != 0;
}

std::string torques(const can::WheelCommand& command) {
  return fmt::format("torque {} and {} mNm", command.left_torque_mNm, command.right_torque_mNm);
}

std::string age(const std::optional<std::uint32_t>& since, std::uint32_t now) {
  return since ? fmt::format("{} ms old", now - *since) : "never came";
}

std::string_view fault_name(std::int32_t code) {
  return core::name_of(static_cast<core::Fault>(code));
}

template <class Message>
bool is_refused(const can::Frame& frame) {
  return can::is<Message>(frame) && !read<Message>(frame);
}

}  // namespace

void Invariants::HonestFrames::send(const can::Frame& frame, std::uint32_t tick) {
  constexpr std::size_t remembered = 600;
  if (frame.id == identifier) {
    sent.emplace_back(frame, tick);
    if (sent.size() > remembered) {
      sent.pop_front();
    }
  }
}

void Invariants::HonestFrames::arrive(const can::Frame& frame) {
  if (frame.id != identifier) {
    return;
  }
  const auto found = std::find_if(sent.rbegin(), sent.rend(), [&](const auto& one) {
    return one.first.length == frame.length && one.first.data == frame.data;
  });
  if (found != sent.rend()) {
    arrived = std::max(arrived.value_or(0), found->second);
  }
}

OutOfReach out_of_reach_of(const std::vector<TimedFault>& faults) {
  OutOfReach result;
  for (const TimedFault& one : faults) {
    const Fault& fault = one.fault;
    if (fault.kind == FaultKind::delay || fault.kind == FaultKind::jitter) {
      result.lateness_ticks += fault.count;
    } else if (fault.kind == FaultKind::replay) {
      const auto is = [&](std::uint16_t identifier) { return fault.message == identifier; };
      const bool slow = is(can::layout<can::VisionPose>.info.id) || is(can::layout<can::VisionBall>.info.id);
      const std::uint32_t recording = slow ? can::slow_window.least_correct : can::fast_window.least_correct;
      if (fault.count < recording) {
        continue;
      }
      if (slow) {
        result.invariants.push_back(Invariant::stale_vision);
      } else if (is(can::layout<can::WheelState>.info.id)) {
        result.invariants.push_back(Invariant::stale_wheels);
      } else if (is(can::layout<can::WheelCommand>.info.id)) {
        result.invariants.insert(result.invariants.end(), {Invariant::stale_command, Invariant::runaway});
      }
    }
  }
  return result;
}

Invariants::Invariants(const WatchedParts& parts, const core::RobotProfile& robot,
                       std::vector<std::uint32_t> reboots, OutOfReach out_of_reach)
    : parts_(parts), robot_(robot), reboots_(std::move(reboots)), out_of_reach_(std::move(out_of_reach)) {}

void Invariants::end_tick(const Snapshot& snapshot) {
  tick_ = snapshot.tick;
  violated_now_ = false;
  if (std::find(reboots_.begin(), reboots_.end(), tick_) != reboots_.end()) {
    told_.reset();
    stop_tick_.reset();
  }
  time_began_anew_ = false;
  hear_seat();
  hear_inputs();
  hear_controller();
  check_freshness();
  check_drives();
  ticks_violated_ += violated_now_ ? 1 : 0;
}

// What was honestly sent, and asked for.
void Invariants::hear_seat() {
  for (const can::Frame& frame : parts_.at_seat.to_controller()) {
    wheels_.send(frame, tick_);
    pose_.send(frame, tick_);
    ball_.send(frame, tick_);
    if (const auto command = read<can::ModeCommand>(frame)) {
      const auto mode = static_cast<can::Mode>(command->mode);
      arm_asked_ = mode == can::Mode::arm || (arm_asked_ && mode != can::Mode::disarm);
      clear_asked_ = clear_asked_ || mode == can::Mode::clear;
    }
  }
}

// What reached the controller.
void Invariants::hear_inputs() {
  for (const can::Frame& frame : parts_.at_controller.to_controller()) {
    wheels_.arrive(frame);
    pose_.arrive(frame);
    ball_.arrive(frame);
    const auto sync = read<can::Sync>(frame);
    if (sync && static_cast<std::uint32_t>(sync->tick) != told_tick_) {
      told_tick_ = static_cast<std::uint32_t>(sync->tick);
      sync_tick_ = tick_;
    }
    if (sync && sync->tick == 0) {
      begin_time_anew();
      time_began_anew_ = true;
    }
    if (read<can::EmergencyStop>(frame) && !stop_tick_) {
      stop_tick_ = tick_;
      clear_asked_ = false;
    }
  }
}

// What the controller made of it, frame by frame: after a stall one tick holds the answers of many.
void Invariants::hear_controller() {
  command_ = {};
  for (const can::Frame& frame : parts_.at_controller.from_controller()) {
    if (is_refused<can::Status>(frame) || is_refused<can::FaultReport>(frame) ||
        is_refused<can::WheelCommand>(frame) || is_refused<can::EndOfTick>(frame)) {
      violate(Invariant::unknown_value, fmt::format("{} with an undeclared value", message_name(frame.id)));
    }
    hear_status(frame);
    commands_.send(frame, tick_);
    if (const auto command = read<can::WheelCommand>(frame)) {
      hear_command(*command);
    }
  }
}

// Every fault but a stop may go with logical time.
void Invariants::begin_time_anew() {
  if (told_ && told_->fault != emergency) {
    told_.reset();
  }
}

void Invariants::hear_status(const can::Frame& frame) {
  const auto status = read<can::Status>(frame);
  if (!status) {
    return;
  }
  // What the controller told in this same tick may be of frames that a stall had kept before the new beginning's.
  if (time_began_anew_ && status->fault == no_fault) {
    begin_time_anew();
  }
  const std::int32_t before = told_ ? told_->fault : no_fault;
  if (before != no_fault && status->fault != before && status->fault != corrupt && !clear_asked_) {
    violate(Invariant::fault_changed, fmt::format("{} became {} without an operator's clear",
                                                  fault_name(before), fault_name(status->fault)));
  }
  if (status->fault != before) {
    commands_since_fault_ = 0;
    clear_asked_ = clear_asked_ && status->fault == no_fault;
  }
  if (before != no_fault && status->fault == no_fault) {
    stop_tick_.reset();
  }
  const bool armed = status->state == active_state && (!told_ || told_->state != active_state);
  if (armed && !arm_asked_) {
    violate(Invariant::unasked_arming, "active, and no operator asked for it");
  }
  arm_asked_ = arm_asked_ && !armed;
  told_ = status;
}

void Invariants::hear_command(const can::WheelCommand& command) {
  command_ = command;
  const auto beyond = [](std::int32_t value, std::int32_t limit) { return std::abs(value) > limit; };
  if (beyond(command.left_torque_mNm, robot_.torque_limit_mNm) ||
      beyond(command.right_torque_mNm, robot_.torque_limit_mNm) ||
      beyond(2 * command.left_set_point_2mm_s, robot_.top_rim_speed_mm_s) ||
      beyond(2 * command.right_set_point_2mm_s, robot_.top_rim_speed_mm_s)) {
    violate(Invariant::limits,
            fmt::format("{}, set-points {} and {} mm/s", torques(command), 2 * command.left_set_point_2mm_s,
                        2 * command.right_set_point_2mm_s));
  }
  const bool faulty = told_ && (told_->state == fault_state || told_->fault != no_fault);
  commands_since_fault_ += faulty ? 1 : 0;
  if (!has_torque(command)) {
    return;
  }
  if (faulty && commands_since_fault_ > most_commands_after_fault) {
    violate(Invariant::fault_torque,
            fmt::format("{} with fault {} told", torques(command), fault_name(told_->fault)));
  } else if (!faulty && (!told_ || told_->state != active_state)) {
    violate(Invariant::unarmed_torque, fmt::format("{} while not armed", torques(command)));
  }
}

void Invariants::check_freshness() {
  if (!has_torque(command_)) {
    return;
  }
  const std::string what = torques(command_);
  const std::uint32_t late = out_of_reach_.lateness_ticks;
  if (stop_tick_ && tick_ - *stop_tick_ > most_ticks_after_stop) {
    violate(Invariant::stop_ignored,
            fmt::format("{}, {} ms after an emergency stop", what, tick_ - *stop_tick_));
  }
  if (wheels_.older_than(oldest_wheels_ticks + late, tick_)) {
    violate(Invariant::stale_wheels, fmt::format("{}, wheel state {}", what, age(wheels_.arrived, tick_)));
  }
  if (pose_.older_than(oldest_vision_ticks + late, tick_) ||
      ball_.older_than(oldest_vision_ticks + late, tick_)) {
    violate(Invariant::stale_vision,
            fmt::format("{}, pose {}, ball {}", what, age(pose_.arrived, tick_), age(ball_.arrived, tick_)));
  }
  if (!sync_tick_ || tick_ - *sync_tick_ > oldest_sync_ticks + late) {
    violate(Invariant::stale_sync, fmt::format("{}, SYNC {}", what, age(sync_tick_, tick_)));
  }
}

void Invariants::check_drives() {
  for (const can::Frame& frame : parts_.at_seat.from_controller()) {
    commands_.arrive(frame);
  }
  const WheelOrders& orders = parts_.drives.orders();
  const bool driven = !parts_.drives.cut(tick_) && (orders[0].torque_Nm != 0.0 || orders[1].torque_Nm != 0.0);
  if (driven && commands_.older_than(oldest_command_ticks + out_of_reach_.lateness_ticks, tick_)) {
    violate(Invariant::stale_command,
            fmt::format("the drives hold {:.3f} and {:.3f} N m, honest command {}", orders[0].torque_Nm,
                        orders[1].torque_Nm, age(commands_.arrived, tick_)));
  }
  const RimSpeeds rims = parts_.plant.measured();
  const double fastest_m_s = std::max(std::abs(rims.left_m_s), std::abs(rims.right_m_s));
  if (fastest_m_s > fastest_rim * robot_.top_rim_speed_mm_s / 1e3) {
    violate(Invariant::runaway, fmt::format("a rim at {:.2f} m/s", fastest_m_s));
  }
}

void Invariants::violate(Invariant invariant, const std::string& text) {
  const auto& unasserted = out_of_reach_.invariants;
  if (std::find(unasserted.begin(), unasserted.end(), invariant) != unasserted.end()) {
    return;
  }
  violated_now_ = true;
  const bool known = std::any_of(violations_.begin(), violations_.end(),
                                 [&](const Violation& one) { return one.invariant == invariant; });
  if (!known) {
    violations_.push_back({.tick = tick_, .invariant = invariant, .text = text});
  }
}

}  // namespace striker::sil

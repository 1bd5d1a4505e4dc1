// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/operator.hpp"

#include <fmt/core.h>

#include <utility>

namespace striker::sil {

can::Frame Operator::command(can::Mode mode, std::int32_t challenge) {
  return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                   mode_counter_);
}

can::Frame Operator::order(can::Mode mode) {
  challenge_ = 0;
  const bool is_request = mode == can::Mode::arm || mode == can::Mode::clear;
  asked_ = is_request ? std::optional(mode) : std::nullopt;
  return command(mode, 0);
}

std::optional<can::Frame> Operator::confirmation() {
  if (challenge_ == 0) {
    return std::nullopt;
  }
  const can::Mode mode = *std::exchange(asked_, std::nullopt);
  return command(mode, std::exchange(challenge_, 0));
}

void Operator::take(const can::Challenge& challenge) {
  if (asked_ && challenge.mode == static_cast<std::int32_t>(*asked_)) {
    challenge_ = challenge.challenge;
  }
}

bool Operator::controller_is_stopped() const {
  return ((faults_ | core::set_of(fault_)) & core::set_of(core::Fault::emergency_stop)) != 0;
}

void Operator::hear(std::span<const can::Frame> frames) {
  for (const can::Frame& frame : frames) {
    can::Status status;
    can::Safety safety;
    can::Version version;
    can::Challenge challenge;
    has_heard_ = true;
    decisions_ += can::is<can::Decision>(frame) ? 1 : 0;
    if (can::is<can::Status>(frame) && can::receive(frame, status) == can::Verdict::accepted) {
      ++statuses_;
      state_ = static_cast<core::State>(status.state);
      has_team_ = static_cast<core::OrderState>(status.orders) != core::OrderState::none;
      fault_ = static_cast<core::Fault>(status.fault);
    } else if (can::is<can::Safety>(frame) && can::receive(frame, safety) == can::Verdict::accepted) {
      faults_ = static_cast<core::Faults>(safety.faults);
    } else if (can::is<can::Challenge>(frame) && can::receive(frame, challenge) == can::Verdict::accepted) {
      take(challenge);
    } else if (can::is<can::Version>(frame) && can::unpack(frame, version) == can::Verdict::accepted) {
      policy_ = fmt::format("{:04x}{:04x}", version.policy_high, version.policy_low);
    }
  }
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/operator.hpp"

#include <fmt/core.h>

namespace striker::sil {

can::Frame Operator::order(can::Mode mode) {
  return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_counter_);
}

void Operator::hear(std::span<const can::Frame> frames) {
  for (const can::Frame& frame : frames) {
    can::Status status;
    can::Version version;
    can::ReceiveCounter any;
    if (can::is<can::Status>(frame) && can::receive(frame, any, status) == can::Verdict::accepted) {
      faulty_ = status.state == static_cast<std::int32_t>(core::State::fault);
    } else if (can::is<can::Version>(frame) && can::unpack(frame, version) == can::Verdict::accepted) {
      policy_ = fmt::format("{:04x}{:04x}", version.policy_high, version.policy_low);
    }
  }
}

}  // namespace striker::sil

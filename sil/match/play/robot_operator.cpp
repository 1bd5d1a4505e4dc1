// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/robot_operator.hpp"

#include <utility>

#include "firmware/core/tick.hpp"

namespace striker::sil {

std::optional<can::Mode> RobotOperator::due() const {
  if (wanted_ && armed_ticks_ != 0) {
    return armed_ticks_ % renewal_ticks == 0 ? std::optional(can::Mode::renew) : std::nullopt;
  }
  // One order a picture's time, in the tick behind it: a challenge is answered before the next. A disarm that was lost
  // is given again.
  if (since_picture_ticks_ % core::decision_period_ticks != 1 || operator_.controller_is_stopped()) {
    return std::nullopt;
  }
  if (!wanted_) {
    return armed_ticks_ != 0 ? std::optional(can::Mode::disarm) : std::nullopt;
  }
  if (operator_.controller_fault() != core::Fault::none) {
    return can::Mode::clear;
  }
  // One that has not heard its team would play by itself.
  const bool is_ready = operator_.controller_state() == core::State::standby && operator_.has_team() &&
                        pictures_ >= pictures_to_arm;
  return is_ready ? std::optional(can::Mode::arm) : std::nullopt;
}

std::optional<can::Frame> RobotOperator::speak() {
  armed_ticks_ = operator_.controller_state() == core::State::active ? armed_ticks_ + 1 : 0;
  const auto mode = due();
  ++since_picture_ticks_;
  if (std::exchange(disarms_, false)) {
    return operator_.order(can::Mode::disarm);
  }
  if (const auto confirmation = operator_.confirmation()) {
    return confirmation;
  }
  return mode ? std::optional(operator_.order(*mode)) : std::nullopt;
}

}  // namespace striker::sil

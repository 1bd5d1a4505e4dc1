// SPDX-License-Identifier: Apache-2.0
// Who sets one robot of a match free and stops it: disarmed in pauses, armed when play goes on, cleared after a fault,
// renewed while it plays. Nobody but a person clears an emergency stop: this operator does not.
//
// Once a tick, in this order:
//   wants(armed), was_placed()    if something changed
//   sees_picture()                if the robot is sent one in this tick
//   speak()                       what the operator says in this tick
//   hear(answer)                  what the controller answered
//
// A robot that was placed is disarmed, so that its controller forgets where it stood; it is armed again when it was
// sent two pictures, as in a kick episode.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "sil/scenario/operator.hpp"

namespace striker::sil {

class RobotOperator {
 public:
  void wants(bool armed) {
    disarms_ = disarms_ || (wanted_ && !armed);
    wanted_ = armed;
  }
  void was_placed() {
    disarms_ = true;
    pictures_ = 0;
  }
  void sees_picture() {
    ++pictures_;
    since_picture_ticks_ = 0;
  }

  [[nodiscard]] std::optional<can::Frame> speak();
  void hear(std::span<const can::Frame> answer) { operator_.hear(answer); }

  // The robot was set free in the tick before.
  [[nodiscard]] bool has_just_armed() const { return armed_ticks_ == 1; }
  [[nodiscard]] const Operator& heard() const { return operator_; }

 private:
  // The request that is due, if any.
  [[nodiscard]] std::optional<can::Mode> due() const;

  static constexpr std::uint32_t pictures_to_arm = 2;
  static constexpr std::uint32_t renewal_ticks = 1'000;

  Operator operator_;
  bool wanted_ = false;
  bool disarms_ = false;
  std::uint32_t pictures_ = 0;  // since it was placed
  std::uint32_t since_picture_ticks_ = 0;
  std::uint32_t armed_ticks_ = 0;  // in a row
};

}  // namespace striker::sil

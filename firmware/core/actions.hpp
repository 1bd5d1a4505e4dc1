// SPDX-License-Identifier: Apache-2.0
// What the controller says in a tick: what the wheels are to do, and what is told about it.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/orders/standing_order.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/state.hpp"
#include "firmware/core/supervision/consent.hpp"

namespace striker::core {

struct WheelTorques {
  std::int32_t left_mNm = 0;
  std::int32_t right_mNm = 0;
  bool operator==(const WheelTorques&) const = default;
};

// For torque drives the torque counts; drives with speed loops of their own take the set-point.
struct DriveCommand {
  WheelTorques torque;
  WheelSpeeds set_point;
  bool operator==(const DriveCommand&) const = default;
};

struct Decision {
  std::uint32_t number = 0;  // from 0, since arming or since the order that began the motion
  std::uint8_t action = 0;
  bool extrapolated = false;      // decided without a new picture
  bool provisional = false;       // a picture that comes within the decision window makes it again
  bool over = false;              // the motion's time is past: the wheels are to stand
  std::int32_t best_q_256th = 0;  // Q of the action, in 1/256
  std::int32_t next_q_256th = 0;  // Q of the best other action
};

struct Actions {
  DriveCommand drive;
  std::optional<Decision> decision;  // in the tick that made one
  State state = State::boot;
  Fault fault = Fault::none;     // the first since the last clear
  Faults faults = 0;             // all of them
  std::uint32_t fault_tick = 0;  // in which it was latched
  std::uint32_t uptime_ticks = 0;
  OpenRequest challenge;                 // in the tick in which something was asked for
  bool vision_ready = false;             // pictures are fresh, and good for a velocity: arming needs that
  bool wheels_ready = false;             // wheel speeds are fresh
  bool kick_over = false;                // as the last decision said, while armed
  OrderState orders = OrderState::none;  // `none`: no team was heard since boot
};

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The team's order that a controller follows once it is armed, and for how long.
//
//   none     since boot no order was taken: the policy acts, as it does without a team
//   motion   the policy acts, from the order that began the motion
//   wheels   the set-points are the order's, each cut to the robot's top speed
//   lapsed   orders were taken, but none since arming, or none that is good now: the wheels are told to stand
//
// An order is good for `order_timeout_ticks` from its reception, and until the team's messages cannot be believed any
// more. Orders are heard while disarmed too, but none of them moves anything after arming: the next one does.
//
// A motion goes on while orders with its number come. It is over for good when it was left, for wheels or because its
// order was not good any more: only another number begins one then, as after its decisions. Right after arming every
// number does.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/core/percepts.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::core {

enum class OrderState : std::uint8_t { none, motion, wheels, lapsed };

inline constexpr std::array<std::string_view, 4> order_state_names = {"none", "motion", "wheels", "lapsed"};

// Without padding: it is part of the sealed state (seal.hpp).
class StandingOrder {
 public:
  // How an arming begins: nothing that was ordered before it counts, but that there is a team. So a robot that has had a
  // believed order since boot never plays by itself when its team is not heard: it stands until it is ordered.
  [[nodiscard]] StandingOrder at_arming() const {
    StandingOrder next;
    next.state_ = state_ == OrderState::none ? OrderState::none : OrderState::lapsed;
    return next;
  }

  // Once a tick, armed or not. Where the policy may not act, `set_point` is what the order makes of it.
  void step(const RobotProfile& robot, std::uint32_t tick, const Percepts& percepts, WheelSpeeds& set_point) {
    if (percepts.order && percepts.order->age_ticks <= order_timeout_ticks) {
      received_tick_ = tick - percepts.order->age_ticks;
      take(robot, *percepts.order, set_point);
    }
    if (state_ != OrderState::none &&
        (tick - received_tick_ > order_timeout_ticks || percepts.invalid.orders)) {
      state_ = OrderState::lapsed;
      set_point = {};
    }
  }

  [[nodiscard]] OrderState state() const { return state_; }
  [[nodiscard]] bool lets_policy_act() const { return state_ <= OrderState::motion; }

  // True once for each motion.
  [[nodiscard]] bool take_beginning() {
    const bool begins = begins_ != 0;
    begins_ = 0;
    return begins;
  }

 private:
  void take(const RobotProfile& robot, const TeamOrder& order, WheelSpeeds& set_point) {
    if (!order.is_motion) {
      state_ = OrderState::wheels;
      set_point = {cut(robot, order.speeds.left_mm_s), cut(robot, order.speeds.right_mm_s)};
    } else if (order.number != number_) {
      number_ = order.number;
      begins_ = 1;
      state_ = OrderState::motion;
    } else if (state_ != OrderState::motion) {
      state_ = OrderState::lapsed;
      set_point = {};
    }
  }
  static std::int32_t cut(const RobotProfile& robot, std::int32_t speed_mm_s) {
    return std::clamp(speed_mm_s, -robot.top_rim_speed_mm_s, robot.top_rim_speed_mm_s);
  }

  std::uint32_t received_tick_ = 0;
  OrderState state_ = OrderState::none;
  std::uint8_t number_ = motion_numbers;  // of the last motion that began; none has this one
  std::uint8_t begins_ = 0;               // until the policy acts
  [[maybe_unused]] std::uint8_t reserved_ = 0;
};

}  // namespace striker::core

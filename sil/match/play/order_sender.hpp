// SPDX-License-Identifier: Apache-2.0
// A team's orders to one robot as frames on its bus, and back. Speeds are rounded to mm/s and cut to what a frame can
// say; an order that was read from a frame makes that frame's payload again. What is no number is an order to stand.
#pragma once

#include <optional>

#include "firmware/can/codec.hpp"
#include "sil/match/team/order.hpp"

namespace striker::sil {

class OrderSender {
 public:
  // A motion's target is in the frame that the robot's camera sees in: the field frame.
  [[nodiscard]] can::Frame frame(const RobotOrder& order);

 private:
  can::SendCounter counter_;  // of all orders to this robot
};

// The order in a frame; none if it is not a valid one.
[[nodiscard]] std::optional<RobotOrder> order_in(const can::Frame& frame);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/order_sender.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "firmware/can/messages/team.hpp"

namespace striker::sil {
namespace {

SpeedOrder speeds_in(const can::Frame& frame) {
  return std::get<SpeedOrder>(order_in(frame).value());
}

TEST(OrderSender, RoundsToTheFramesCounts) {
  OrderSender sender;
  EXPECT_EQ(speeds_in(sender.frame(SpeedOrder{1.2344, -2.5506})), (SpeedOrder{1.234, -2.551}));
}

TEST(OrderSender, WhatWasReadMakesTheSamePayload) {
  for (int mm_s = -8000; mm_s <= 8000; mm_s += 7) {
    OrderSender one;
    OrderSender other;
    const can::Frame frame = one.frame(SpeedOrder{mm_s / 1e3, -mm_s / 1e3});
    EXPECT_EQ(other.frame(*order_in(frame)).data, frame.data);
  }
  for (int i = -180; i <= 180; ++i) {
    OrderSender one;
    OrderSender other;
    const Pose target = {i * 0.02, i * -0.011, i * std::numbers::pi / 180.0};
    const can::Frame frame =
        one.frame(MotionOrder{.number = static_cast<std::uint8_t>(i & 3), .target = target});
    EXPECT_EQ(other.frame(*order_in(frame)).data, frame.data);
  }
}

TEST(OrderSender, WhatIsNoNumberStands) {
  OrderSender sender;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(speeds_in(sender.frame(SpeedOrder{nan, nan})), SpeedOrder{});
  EXPECT_EQ(speeds_in(sender.frame(SpeedOrder{infinite, -infinite})), (SpeedOrder{8.0, -8.0}));
  EXPECT_TRUE(order_in(sender.frame(MotionOrder{.target = {nan, infinite, nan}})));
}

TEST(OrderSender, BothKindsCountOn) {
  OrderSender sender;
  const can::Frame speeds = sender.frame(SpeedOrder{});
  const can::Frame motion = sender.frame(MotionOrder{});
  EXPECT_NE(speeds.data[1] & 0xF, motion.data[1] & 0xF);
}

TEST(OrderSender, ADamagedFrameIsNoOrder) {
  OrderSender sender;
  can::Frame frame = sender.frame(SpeedOrder{1.0, 1.0});
  frame.data[2] ^= 1;
  EXPECT_FALSE(order_in(frame));
}

}  // namespace
}  // namespace striker::sil

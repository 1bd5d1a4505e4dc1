// SPDX-License-Identifier: Apache-2.0
// What a team's orders may do and may not, seen from outside: they neither arm nor excuse anything, and count from arming
// to disarm alone. The node stands behind its gate, as on every port.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/loop/bench/team_rig.hpp"

namespace striker::loop {
namespace {

using core::OrderState;
using core::State;
using core::WheelSpeeds;

TEST(OrderPromise, OrdersAloneNeverMoveAWheel) {
  TeamRig rig;
  for (int i = 0; i < 10'000; ++i) {
    rig.order = i / 100 % 2 == 0 ? SentOrder(ahead) : SentOrder(can::MotionOrder{.number = i / 200 % 4});
    rig.live();
    ASSERT_FALSE(rig.torque() || rig.is_told_to_move());
    ASSERT_NE(rig.state(), State::active);
  }
}

TEST(OrderPromise, ArmingWithoutATeamIsThePolicy) {
  TeamRig rig;
  rig.live(170);
  rig.arm_now();
  rig.live(2'500);
  EXPECT_EQ(rig.orders(), OrderState::none);
  EXPECT_GE(rig.decisions, 40U);
}

// A team that is not heard any more must not set its robot free to play by itself.
TEST(OrderPromise, OnceATeamWasHeardAnArmedRobotStandsUntilItIsOrdered) {
  TeamRig rig;
  rig.order = ahead;
  rig.live(170);
  rig.order.reset();
  for (int armings = 0; armings < 3; ++armings) {
    rig.arm_now();
    for (int i = 0; i < 2'500; ++i) {
      rig.live();
      ASSERT_FALSE(rig.is_told_to_move()) << i;
      ASSERT_EQ(rig.orders(), OrderState::lapsed);
    }
    rig.mode(can::Mode::disarm);
    rig.live(170);
  }
  EXPECT_EQ(rig.decisions, 0U);
}

TEST(OrderPromise, AnOrderInTheTickOfArmingDoesNotCount) {
  TeamRig rig;
  rig.order = ahead;
  rig.live_until(197);
  rig.mode(can::Mode::arm);  // takes a tick
  rig.phase_ticks = 198 % 50;
  rig.order = ahead;
  rig.live();
  ASSERT_EQ(rig.state(), State::active);
  rig.order.reset();
  rig.live(20);
  EXPECT_EQ(rig.orders(), OrderState::lapsed);
  EXPECT_FALSE(rig.is_told_to_move());
}

TEST(OrderPromise, ADisarmForgetsEveryOrder) {
  TeamRig rig;
  rig.order = can::MotionOrder{.number = 2};
  rig.arm_under_orders();
  rig.live(20);
  ASSERT_EQ(rig.orders(), OrderState::motion);
  rig.mode(can::Mode::disarm);
  rig.live();
  EXPECT_EQ(rig.state(), State::standby);
  EXPECT_FALSE(rig.torque() || rig.is_told_to_move());
  rig.live(170);
  rig.order.reset();
  rig.arm_now();
  rig.live(15);
  EXPECT_EQ(rig.orders(), OrderState::lapsed);
  rig.order = can::MotionOrder{.number = 2};
  rig.live_to_an_order();
  rig.live(10);
  EXPECT_EQ(rig.orders(), OrderState::motion) << "every number is new after an arming";
}

TEST(OrderPromise, AStopAndADisarmBeatAnOrderOfTheSameTick) {
  for (const bool stop : {true, false}) {
    for (const bool order_first : {true, false}) {
      TeamRig rig = driving();
      if (order_first) {
        rig.say(can::WheelOrder{.left_mm_s = 700});
      }
      if (stop) {
        rig.stop();
      } else {
        rig.mode(can::Mode::disarm);
      }
      if (!order_first) {
        rig.say(can::WheelOrder{.left_mm_s = 700});
      }
      for (int i = 0; i < 1'000; ++i) {
        rig.live();
        ASSERT_FALSE(rig.torque() || rig.is_told_to_move());
      }
      EXPECT_EQ(rig.state(), stop ? State::fault : State::standby);
    }
  }
}

TEST(OrderPromise, OrdersDoNotDriveBlindNorUnwatched) {
  TeamRig blind = driving();
  blind.send_vision = false;
  EXPECT_LE(moved_until(blind, 2'000, [](std::uint32_t) {}), 150U);
  EXPECT_EQ(blind.fault(), core::Fault::vision_lost);

  TeamRig deaf = driving();
  deaf.send_wheels = false;
  EXPECT_LE(moved_until(deaf, 2'000, [](std::uint32_t) {}), 20U);
  EXPECT_EQ(deaf.fault(), core::Fault::wheel_state_lost);

  TeamRig unwatched = driving();
  for (std::uint32_t tick = 0; tick < 10'100; ++tick) {
    if (tick % 50 == 0) {
      unwatched.extra.push_back(unwatched.next_frame());
    }
    unwatched.tick();
  }
  EXPECT_EQ(unwatched.fault(), core::Fault::dead_man) << "an order is no renewal";
}

TEST(OrderPromise, EachWheelIsCutToTheRobotsTopSpeed) {
  const std::int32_t top = built_in_robot.top_rim_speed_mm_s;
  TeamRig rig = driving();
  for (const auto& [left, right] :
       {std::pair{8'000, 100}, {-8'000, -100}, {top, -top}, {top + 1, -top - 1}, {100, 8'000}}) {
    rig.say(can::WheelOrder{.left_mm_s = left, .right_mm_s = right});
    rig.live();
    const WheelSpeeds cut = {std::clamp(left, -top, top) / 2 * 2, std::clamp(right, -top, top) / 2 * 2};
    EXPECT_EQ(rig.set_point(), cut) << left << " " << right;
    EXPECT_EQ(rig.node.gate().active_limits(), 0U);
  }
  EXPECT_EQ(rig.state(), State::active);
}

TEST(OrderPromise, OfSeveralOrdersInATickTheLastCounts) {
  TeamRig rig = driving();
  rig.say(can::WheelOrder{.left_mm_s = 100});
  rig.say(can::MotionOrder{});
  rig.say(can::WheelOrder{.left_mm_s = -100, .right_mm_s = 50});
  rig.order.reset();
  rig.live();
  EXPECT_EQ(rig.set_point(), (WheelSpeeds{-100, 50}));
  rig.decisions = 0;
  rig.live(50);
  EXPECT_EQ(rig.decisions, 0U);
}

}  // namespace
}  // namespace striker::loop

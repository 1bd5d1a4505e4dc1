// SPDX-License-Identifier: Apache-2.0
// The kick as a motion that a team orders: where it begins, when it is over, and what its number says.
#include <gtest/gtest.h>

#include <vector>

#include "tests/loop/bench/team_rig.hpp"

namespace striker::loop {
namespace {

using core::OrderState;
using core::State;
using core::WheelSpeeds;

constexpr std::uint32_t kick_ticks = 40 * 50;
constexpr can::WheelOrder stand = {};

// Armed, and told to stand, shortly before the ball comes.
TeamRig standing() {
  TeamRig rig;
  rig.order = stand;
  rig.arm_under_orders();
  rig.live_until(7'990);
  rig.decision.reset();
  rig.decisions = 0;
  return rig;
}

std::uint32_t ticks_moved(TeamRig& rig, std::uint32_t ticks) {
  std::uint32_t moved = 0;
  for (std::uint32_t i = 0; i < ticks; ++i) {
    rig.live();
    moved += rig.is_told_to_move() ? 1 : 0;
  }
  return moved;
}

TEST(MotionOrder, BeginsInTheTickOfItsOrderWhateverTheCamerasPhase) {
  for (std::uint32_t phase = 0; phase < 50; ++phase) {
    TeamRig rig = standing();
    rig.live_until(8'000 + phase);
    rig.say(can::MotionOrder{.number = 1});
    rig.order.reset();
    rig.live();
    EXPECT_EQ(rig.status.state, static_cast<std::int32_t>(State::active));
    rig.live(6);  // a decision without its picture is told when the window for one is over
    ASSERT_TRUE(rig.decision) << phase;
    EXPECT_EQ(rig.decision->number, 0) << phase;
  }
}

TEST(MotionOrder, IsTheKickOfAnArmingDecisionForDecision) {
  TeamRig ordered = standing();
  TeamRig armed;
  armed.live_until(7'990);
  armed.arm_now();
  ordered.live_until(8'000);
  armed.live_until(8'000);
  ordered.order = can::MotionOrder{.number = 3};
  std::uint32_t moved = 0;
  for (std::uint32_t tick = 0; tick < kick_ticks + 200; ++tick) {
    ordered.live();
    armed.live();
    ASSERT_EQ(ordered.set_point(), armed.set_point()) << tick;
    ASSERT_EQ(ordered.decision.has_value(), armed.decision.has_value());
    if (armed.decision) {
      ASSERT_EQ(can::pack(*ordered.decision), can::pack(*armed.decision)) << tick;
    }
    moved += ordered.is_told_to_move() ? 1 : 0;
  }
  EXPECT_GT(moved, 0U);
}

TEST(MotionOrder, StandsAfterFortyDecisionsUntilAnotherNumberComes) {
  TeamRig rig = standing();
  rig.order = can::MotionOrder{.number = 0};
  rig.live_until(8'001);
  EXPECT_GT(ticks_moved(rig, kick_ticks - 1), 0U);
  EXPECT_EQ(rig.status.kick_over, 0);
  EXPECT_EQ(ticks_moved(rig, 3'000), 0U) << "the same number goes on, and it is over";
  EXPECT_EQ(rig.status.kick_over, 1);
  EXPECT_EQ(rig.state(), State::active);
  rig.live_until(16'000);
  rig.order = can::MotionOrder{.number = 1};
  EXPECT_GT(ticks_moved(rig, kick_ticks), 0U);
  EXPECT_EQ(rig.status.kick_over, 0);
}

TEST(MotionOrder, EveryOtherNumberBeginsItAnewAndAfterThreeComesNone) {
  TeamRig rig = standing();
  for (const std::int32_t number : {0, 1, 2, 3, 0, 3, 1}) {
    rig.order = can::MotionOrder{.number = number};
    rig.live_to_an_order();
    ASSERT_TRUE(rig.decision);
    EXPECT_EQ(rig.decision->number, 0) << number;
    rig.live(50 * 3);
    EXPECT_EQ(rig.decision->number, 3) << "the same number goes on";
  }
}

TEST(MotionOrder, ThatWasLeftForWheelsIsNotTakenUpAgain) {
  TeamRig rig = standing();
  rig.live_until(8'000);
  rig.order = can::MotionOrder{.number = 2};
  rig.live(200);
  ASSERT_EQ(rig.orders(), OrderState::motion);
  rig.order = can::WheelOrder{.left_mm_s = 100, .right_mm_s = 100};
  rig.live(100);
  EXPECT_EQ(rig.set_point(), (WheelSpeeds{100, 100}));
  EXPECT_EQ(rig.orders(), OrderState::wheels);
  const std::uint32_t decisions = rig.decisions;
  rig.live(100);
  EXPECT_EQ(rig.decisions, decisions) << "no policy, no Decision";
  rig.order = can::MotionOrder{.number = 2};
  rig.live_to_an_order();
  EXPECT_EQ(ticks_moved(rig, 500), 0U);
  EXPECT_EQ(rig.orders(), OrderState::lapsed);
  rig.order = can::MotionOrder{.number = 3};
  rig.live(60);
  EXPECT_EQ(rig.orders(), OrderState::motion);
}

TEST(MotionOrder, WhoseOrderWasNotGoodAnyMoreIsOver) {
  TeamRig rig = standing();
  rig.live_until(8'000);
  rig.order = can::MotionOrder{.number = 2};
  rig.live(101);
  rig.order.reset();
  rig.live(149);
  EXPECT_EQ(rig.orders(), OrderState::motion);
  rig.live(12);
  EXPECT_EQ(rig.orders(), OrderState::lapsed);
  EXPECT_FALSE(rig.is_told_to_move());
  rig.order = can::MotionOrder{.number = 2};
  EXPECT_EQ(ticks_moved(rig, 1'000), 0U);
  rig.order = can::MotionOrder{.number = 1};
  rig.decision.reset();
  rig.live_to_an_order();
  ASSERT_TRUE(rig.decision);
  EXPECT_EQ(rig.decision->number, 0);
}

TEST(MotionOrder, OfAMotionThatIsNotKnownIsRefused) {
  TeamRig rig = standing();
  rig.order.reset();
  can::SendCounter& team = rig.team();
  can::Frame frame = can::pack(can::MotionOrder{.number = 1});
  frame.data[1] |= 0x40U;  // motion 1
  can::protect(frame, can::layout<can::MotionOrder>.info.data_ids, team.next);
  rig.extra.push_back(frame);
  rig.live(7);
  EXPECT_EQ(rig.node.node().ignored().out_of_range, 1);
  EXPECT_EQ(rig.decisions, 0U);
}

// Wheel orders take over from the policy in the tick in which they come, and the first of them after arming too.
TEST(MotionOrder, AFirstWheelOrderEndsTheKickThatArmingBegan) {
  TeamRig rig;
  rig.live_until(188);
  rig.mode(can::Mode::arm);
  rig.live_until(230);
  EXPECT_EQ(rig.orders(), OrderState::none);
  EXPECT_GT(rig.decisions, 0U);
  rig.order = can::WheelOrder{.left_mm_s = 100, .right_mm_s = -100};
  rig.live(400);
  EXPECT_EQ(rig.set_point(), (WheelSpeeds{100, -100}));
  rig.decisions = 0;
  rig.live(300);
  EXPECT_EQ(rig.decisions, 0U);
  EXPECT_EQ(rig.orders(), OrderState::wheels);
}

}  // namespace
}  // namespace striker::loop

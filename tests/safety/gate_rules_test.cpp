// SPDX-License-Identifier: Apache-2.0
// The command gate by itself, at each of its limits: a node behind it sends what it likes.
#include <gtest/gtest.h>

#include <array>

#include "tests/safety/gate_fixture.hpp"

namespace striker::safety {
namespace {

TEST_F(GateRules, NothingMovesWithoutAConfirmedArm) {
  feed(13);
  EXPECT_FALSE(moves());
  EXPECT_TRUE(gate.has_blocked());
  EXPECT_EQ(gate.blocked(), 1U);
  confirm(arm);
  EXPECT_FALSE(moves()) << "what was blocked stays shut until a clear";
  confirm(clear);
  EXPECT_FALSE(gate.has_blocked());
  EXPECT_FALSE(moves()) << "a clear does not arm";
  confirm(clear);
  confirm(arm);
  EXPECT_TRUE(moves());
}

TEST_F(GateRules, AllZeroPassesAlways) {
  EXPECT_EQ(command({}).left_torque_mNm, 0);
  EXPECT_FALSE(gate.has_blocked());
  EXPECT_EQ(gate.blocked(), 0U);
  EXPECT_EQ(gate.active_limits(), 0U);
}

// A torque field of 12 bits holds up to 2047, and 2000 is its greatest value: no drive takes such a frame.
TEST_F(GateRules, WhatIsOutOfRangeMovesNothing) {
  can::Frame frame = can::pack(can::WheelCommand{});
  frame.data[2] = 0xFF;
  frame.data[3] = 0x07;
  can::protect(frame, can::layout<can::WheelCommand>.info.data_ids, 0);
  EXPECT_EQ(send(frame).frames().front(), frame);
  EXPECT_FALSE(gate.has_blocked());
}

TEST_F(GateRules, ASetPointAloneMoves) {
  feed(13);
  EXPECT_EQ(command({.right_set_point_2mm_s = 1}).right_set_point_2mm_s, 0);
  EXPECT_TRUE(gate.has_blocked());
}

TEST_F(GateRules, AChallengeIsGoodOnceForItsModeAndInTime) {
  feed(13);
  challenge(arm, 5);
  order(arm, 6);
  EXPECT_FALSE(moves()) << "another number";
  confirm(clear);
  order(arm, 77);
  EXPECT_FALSE(moves()) << "the number of another request";
  confirm(clear);
  challenge(clear, 5);
  order(arm, 5);
  EXPECT_FALSE(moves()) << "another mode";
  confirm(clear);
  challenge(arm, 5);
  order(arm, 6);
  order(arm, 5);
  EXPECT_FALSE(moves()) << "a wrong number closes it";
  confirm(clear);
  order(arm, 0);
  EXPECT_FALSE(moves()) << "a request is no confirmation, even where nothing is open";
  confirm(clear);
  challenge(arm, 5);
  order(arm, 0);
  order(arm, 5);
  EXPECT_TRUE(moves()) << "a request does not close it";
}

// A second tool that asks, or renews, takes nothing from the one that is about to confirm.
TEST_F(GateRules, ARequestLeavesTheOpenChallengeOpen) {
  for (const std::int32_t mode : {arm, clear, renew}) {
    feed(13);
    challenge(arm, 5);
    order(mode, 0);
    order(arm, 5);
    EXPECT_TRUE(moves()) << mode;
    order(static_cast<std::int32_t>(can::Mode::disarm), 0);
  }
}

TEST_F(GateRules, ARequestBehindAConfirmationTakesNothingFromIt) {
  feed(13);
  challenge(arm, 5);
  can::SendCounter counter;
  const std::array frames = {can::send(can::ModeCommand{.mode = arm, .challenge = 5}, counter),
                             can::send(can::ModeCommand{.mode = clear}, counter)};
  gate.take(frames, tick);
  EXPECT_TRUE(moves());
}

TEST_F(GateRules, AChallengeLastsItsTime) {
  for (const std::uint32_t wait : {600U, 601U}) {
    SCOPED_TRACE(wait);
    order(disarm, 0);
    challenge(arm, 5);
    feed(wait);
    order(arm, 5);
    EXPECT_EQ(moves(), wait == 600);
  }
}

TEST_F(GateRules, AChallengeOutOfRangeGivesTheOpenOneNoMoreTime) {
  feed(13);
  challenge(arm, 5);
  feed(500);
  can::SendCounter counter;
  can::Frame none = can::send(can::Challenge{.mode = arm, .challenge = 1}, counter);
  none.data[2] = 0;  // a challenge is never 0
  can::protect(none, can::layout<can::Challenge>.info.data_ids, can::counter_of(none));
  send(none);
  feed(101);
  order(arm, 5);
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, WhatMovesHasWheelStatesWithinTheirTime) {
  drive();
  sends_wheels = false;
  feed(24);
  EXPECT_TRUE(moves()) << "25 ticks after the last";
  feed();
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, WhatMovesHasPosesAndBallsWithinTheirTime) {
  for (bool* const kind : {&sends_poses, &sends_balls}) {
    confirm(clear);
    drive();
    *kind = false;
    feed(199);
    EXPECT_TRUE(moves()) << "200 ticks after the last";
    feed();
    EXPECT_FALSE(moves());
    *kind = true;
  }
}

TEST_F(GateRules, InputsAreAsOldAsTheyAre) {
  drive();
  sends_wheels = false;
  feed(20);
  can::SendCounter counter{.next = 13};
  can::Frame waited = can::send(can::WheelState{}, counter);
  waited.age_ms = 10;
  receive(waited);
  feed(15);
  EXPECT_TRUE(moves());
  feed();
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, BeingArmedEndsAndIsRenewed) {
  drive();
  for (int renewal = 0; renewal < 4; ++renewal) {
    feed(2'500);
    order(renew, 0);
  }
  feed(10'100);
  EXPECT_TRUE(moves());
  feed();
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, ADisarmEndsIt) {
  drive();
  order(static_cast<std::int32_t>(can::Mode::disarm), 0);
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, AWrongOrderChangesNothing) {
  drive();
  can::SendCounter counter;
  can::Frame wrong = can::send(can::ModeCommand{}, counter);
  wrong.data[0] ^= 1U;
  receive(wrong);
  can::Frame wrong_stop = can::send(can::EmergencyStop{}, counter);
  wrong_stop.data[0] ^= 1U;
  receive(wrong_stop);
  EXPECT_TRUE(moves());
}

TEST_F(GateRules, AStopShutsUntilAClearIsConfirmed) {
  drive();
  can::SendCounter counter;
  receive(can::send(can::EmergencyStop{}, counter));
  receive(can::send(can::WheelState{}, counter));
  EXPECT_FALSE(moves());
  confirm(arm);
  EXPECT_FALSE(moves());
}

// What was blocked in the first moments may be cleared in them: only a stop holds for a time.
TEST_F(GateRules, AClearWithoutAStopWaitsForNothing) {
  tick = 1;
  EXPECT_FALSE(moves());
  EXPECT_TRUE(gate.has_blocked());
  confirm(clear);
  EXPECT_FALSE(gate.has_blocked());
}

TEST_F(GateRules, AStopAloneBlocksAnArm) {
  feed(13);
  can::SendCounter counter;
  receive(can::send(can::EmergencyStop{}, counter));
  confirm(arm);
  EXPECT_FALSE(gate.has_blocked());
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, AFaultOfTheControllersEndsIt) {
  drive();
  can::SendCounter counter;
  send(can::send(can::FaultReport{.code = 3}, counter));
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, ARestartEndsConsentAndKeepsAStop) {
  drive();
  gate.restart();
  feed(13);
  EXPECT_FALSE(moves());
  confirm(clear);
  drive();
  can::SendCounter counter;
  receive(can::send(can::EmergencyStop{}, counter));
  gate.restart();
  feed(13);
  confirm(arm);
  EXPECT_FALSE(moves());
}

TEST_F(GateRules, BlockedCommandsAreCountedUpTo255) {
  for (int i = 1; i <= 300; ++i) {
    EXPECT_FALSE(moves());
    EXPECT_EQ(gate.blocked(), std::min(i, 255));
  }
}

TEST_F(GateRules, TorqueSlewAndSetPointsAreCutAndTold) {
  drive();
  command({.left_torque_mNm = 200, .right_torque_mNm = -200});
  EXPECT_EQ(gate.active_limits(), 0U);
  EXPECT_EQ(command({.left_torque_mNm = 401, .right_torque_mNm = -400}).left_torque_mNm, 400);
  EXPECT_EQ(gate.active_limits(), can::limit_torque);
  EXPECT_EQ(command({.left_torque_mNm = 100, .right_torque_mNm = -401}).right_torque_mNm, -400);
  EXPECT_EQ(gate.active_limits(), can::limit_torque);
  const can::WheelCommand slow = command({.left_torque_mNm = -201, .right_torque_mNm = -100});
  EXPECT_EQ(slow.left_torque_mNm, -200);
  EXPECT_EQ(slow.right_torque_mNm, -100);
  EXPECT_EQ(gate.active_limits(), can::limit_slew);
  const can::WheelCommand fast = command({.left_set_point_2mm_s = 1001, .right_set_point_2mm_s = -1001});
  EXPECT_EQ(fast.left_set_point_2mm_s, 1000);
  EXPECT_EQ(fast.right_set_point_2mm_s, -1000);
  EXPECT_EQ(gate.active_limits(), can::limit_set_point);
  command({.left_set_point_2mm_s = 1000, .right_set_point_2mm_s = -1000});
  EXPECT_EQ(gate.active_limits(), 0U);
  EXPECT_FALSE(gate.has_blocked()) << "a limit is no fault";
}

TEST_F(GateRules, TheSlewBeginsAtWhatWentOutLast) {
  drive();
  command({.left_torque_mNm = 300, .right_torque_mNm = 300});
  command({});
  EXPECT_EQ(command({.left_torque_mNm = -300, .right_torque_mNm = -301}).right_torque_mNm, -300);
  EXPECT_EQ(gate.active_limits(), can::limit_slew);
}

TEST_F(GateRules, WhatPassesStaysAsItIs) {
  drive();
  can::SendCounter counter{.next = 9};
  const can::Frame frame = can::send(some_command, counter);
  EXPECT_EQ(send(frame).frames().front(), frame);
  order(static_cast<std::int32_t>(can::Mode::disarm), 0);
  const can::Frame zero = send(frame).frames().front();
  EXPECT_EQ(can::counter_of(zero), 9) << "the same one in the sequence";
}

TEST_F(GateRules, WhatIsNotOnTheWhitelistIsCounted) {
  can::FrameList frames;
  frames.add(can::pack(can::Heartbeat{}));
  frames.add(can::pack(can::VisionPose{}));
  frames.add(can::pack(can::EmergencyStop{}));
  gate.check(frames, tick);
  EXPECT_EQ(frames.frames().size(), 1U);
  EXPECT_EQ(gate.refused(), 2U);
}

}  // namespace
}  // namespace striker::safety

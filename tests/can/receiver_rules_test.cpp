// SPDX-License-Identifier: Apache-2.0
// What the receiver makes of each message, and of what is wrong.
#include "firmware/can/receiver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware/can/drives/striker_drives.hpp"

namespace striker::can {
namespace {

class ReceiverRules : public testing::Test {
 protected:
  Receiver receiver;
  StrikerDrives drives;
  SendCounter pose, ball, wheels, mode, stop, team;
  std::uint32_t tick = 1000;

  core::Percepts take(const std::vector<Frame>& frames) { return receiver.take(frames, ++tick, drives); }
  core::Percepts order(Mode wanted, std::int32_t challenge = 0) {
    return take({send(ModeCommand{.mode = static_cast<std::int32_t>(wanted), .challenge = challenge}, mode)});
  }
  Frame picture_of_robot() {
    Frame frame = send(VisionPose{.frame = 3, .x_quarter_mm = 40, .y_quarter_mm = -80, .heading = 100}, pose);
    frame.age_ms = 5;
    return frame;
  }
  Frame picture_of_ball() {
    Frame frame = send(VisionBall{.frame = 4, .x_quarter_mm = -40, .y_quarter_mm = 80}, ball);
    frame.age_ms = 6;
    return frame;
  }
  Frame wheel_state() {
    Frame frame = send(WheelState{.torque_cut = 1, .left_mm_s = 10, .right_mm_s = -20}, wheels);
    frame.age_ms = 2;
    return frame;
  }
  void begin() {
    for (int i = 0; i < 13; ++i) {
      take({picture_of_robot(), picture_of_ball(), wheel_state()});
    }
  }
};

TEST_F(ReceiverRules, SightingsAndSpeedsComeInTheCoresUnitsWithTheirAge) {
  begin();
  const core::Percepts percepts = take({picture_of_robot(), picture_of_ball(), wheel_state()});
  ASSERT_TRUE(percepts.robot && percepts.ball && percepts.wheels);
  EXPECT_EQ(percepts.robot->picture, 3);
  EXPECT_EQ(percepts.robot->position_um.x, 10'000);
  EXPECT_EQ(percepts.robot->position_um.y, -20'000);
  EXPECT_EQ(percepts.robot->heading, 100);
  EXPECT_EQ(percepts.robot->age_ticks, 5);
  EXPECT_EQ(percepts.ball->picture, 4);
  EXPECT_EQ(percepts.ball->position_um.x, -10'000);
  EXPECT_EQ(percepts.ball->age_ticks, 6);
  EXPECT_EQ(percepts.wheels->left_mm_s, 10);
  EXPECT_EQ(percepts.wheels->right_mm_s, -20);
  EXPECT_EQ(percepts.wheels_age_ticks, 2);
  EXPECT_TRUE(percepts.drives_cut);
  EXPECT_FALSE(percepts.invalid.vision || percepts.invalid.wheels || percepts.invalid.operators);
  EXPECT_FALSE(percepts.second_controller || percepts.emergency_stop);
}

TEST_F(ReceiverRules, NothingComesOfNothing) {
  const core::Percepts percepts = take({});
  EXPECT_FALSE(percepts.robot || percepts.ball || percepts.wheels || percepts.drives_cut ||
               percepts.emergency_stop || percepts.second_controller || percepts.requests.disarm ||
               percepts.requests.renew);
}

TEST_F(ReceiverRules, OrdersAreRequestsOrConfirmations) {
  EXPECT_EQ(order(Mode::arm).requests.asked, core::Order::arm);
  EXPECT_EQ(order(Mode::clear).requests.asked, core::Order::clear);
  EXPECT_TRUE(order(Mode::renew).requests.renew);
  EXPECT_FALSE(order(Mode::arm).requests.renew);
  EXPECT_TRUE(order(Mode::disarm).requests.disarm);
  EXPECT_FALSE(order(Mode::renew).requests.disarm);
  const core::Requests confirmed = order(Mode::arm, 99).requests;
  EXPECT_EQ(confirmed.asked, core::Order::none);
  EXPECT_EQ(confirmed.confirmed.order, core::Order::arm);
  EXPECT_EQ(confirmed.confirmed.challenge, 99U);
  EXPECT_EQ(order(Mode::clear, 1).requests.confirmed.order, core::Order::clear);
  EXPECT_EQ(order(Mode::renew, 5).requests.confirmed.order, core::Order::none);
  EXPECT_EQ(order(Mode::disarm, 5).requests.confirmed.order, core::Order::none);
}

TEST_F(ReceiverRules, ADisarmDropsTheSightingsBeforeIt) {
  begin();
  const Frame disarm = send(ModeCommand{}, mode);
  const core::Percepts before = take({picture_of_robot(), picture_of_ball(), disarm});
  EXPECT_FALSE(before.robot || before.ball);
  const core::Percepts after = take({disarm, picture_of_robot(), picture_of_ball()});
  EXPECT_TRUE(after.robot && after.ball);
}

TEST_F(ReceiverRules, AStopStaysPressedForItsTickWhateverFollows) {
  Frame wrong = send(EmergencyStop{}, stop);
  wrong.data[0] ^= 1U;
  const core::Percepts percepts = take({send(EmergencyStop{.source = 7}, stop), wrong});
  EXPECT_TRUE(percepts.emergency_stop);
  EXPECT_TRUE(percepts.invalid.operators);
  EXPECT_FALSE(take({wrong}).emergency_stop);
}

TEST_F(ReceiverRules, WhatIsWrongOfOperatorsIsRememberedForTheTick) {
  Frame wrong = send(ModeCommand{}, mode);
  wrong.data[0] ^= 1U;
  const core::Percepts percepts = take({wrong, send(ModeCommand{.mode = 0}, mode)});
  EXPECT_TRUE(percepts.invalid.operators);
  EXPECT_TRUE(percepts.requests.disarm);
  EXPECT_FALSE(order(Mode::renew).invalid.operators);
}

TEST_F(ReceiverRules, RenewalsCountInSequenceAndNotWhenTheyAreRepeated) {
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(order(Mode::renew).requests.renew, i >= 2) << i;
  }
  const Frame old = send(ModeCommand{.mode = 3}, mode);
  EXPECT_TRUE(take({old}).requests.renew);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(take({old}).requests.renew);
  }
}

// One that comes twice is no sender's, and what follows it is believed after as many in sequence as it takes after any
// contradiction.
TEST_F(ReceiverRules, ARepeatedRenewalIsAContradiction) {
  for (int i = 0; i < 8; ++i) {
    order(Mode::renew);
  }
  const Frame twice = send(ModeCommand{.mode = 3}, mode);
  EXPECT_TRUE(take({twice}).requests.renew);
  EXPECT_FALSE(take({twice}).requests.renew);
  for (std::uint32_t step = 1; step <= slow_window.steps_alone; ++step) {
    EXPECT_EQ(order(Mode::renew).requests.renew, step >= slow_window.steps_alone) << step;
  }
}

TEST_F(ReceiverRules, InvalidPicturesAreToldAndNotTaken) {
  for (const bool robot : {true, false}) {
    begin();
    for (int i = 0; i < 4; ++i) {
      Frame wrong = robot ? picture_of_robot() : picture_of_ball();
      wrong.data[0] ^= 1U;
      take({wrong});
    }
    const core::Percepts percepts = take({robot ? picture_of_robot() : picture_of_ball()});
    EXPECT_TRUE(percepts.invalid.vision);
    EXPECT_FALSE(percepts.robot || percepts.ball);
    receiver = {};
  }
}

TEST_F(ReceiverRules, AnInvalidMessageIsToldWhateverElseComes) {
  begin();
  for (int i = 0; i < 4; ++i) {
    Frame wrong = picture_of_robot();
    wrong.data[0] ^= 1U;
    take({wrong, picture_of_ball()});
  }
  EXPECT_TRUE(take({picture_of_robot(), picture_of_ball()}).invalid.vision);
}

TEST_F(ReceiverRules, BothKindsOfOrdersAreOneSequence) {
  for (int i = 0; i < 9; ++i) {
    Frame wheels_order = send(WheelOrder{.left_mm_s = 300, .right_mm_s = -200}, team);
    wheels_order.age_ms = 7;
    const core::Percepts wheels_ordered = take({wheels_order});
    ASSERT_EQ(wheels_ordered.order.has_value(), i > 0) << "as any message that is not critical at power-on";
    if (i > 0) {
      EXPECT_FALSE(wheels_ordered.order->is_motion);
      EXPECT_EQ(wheels_ordered.order->speeds, (core::WheelSpeeds{300, -200}));
      EXPECT_EQ(wheels_ordered.order->age_ticks, 7);
    }
    const core::Percepts motion_ordered = take({send(MotionOrder{.number = i % 4}, team)});
    ASSERT_EQ(motion_ordered.order.has_value(), i > 0);
    if (i > 0) {
      EXPECT_TRUE(motion_ordered.order->is_motion);
      EXPECT_EQ(motion_ordered.order->number, i % 4);
    }
  }
  EXPECT_EQ(receiver.ignored().wrong_counter, 2);
}

TEST_F(ReceiverRules, AnotherKindOfOrderWithTheSameCounterIsAContradiction) {
  for (int i = 0; i < 9; ++i) {
    take({send(WheelOrder{}, team)});
  }
  SendCounter same = team;
  const core::Percepts percepts = take({send(WheelOrder{}, team)});
  ASSERT_TRUE(percepts.order && !percepts.invalid.orders);
  const core::Percepts contradicted = take({send(MotionOrder{}, same)});
  EXPECT_FALSE(contradicted.order);
  EXPECT_TRUE(contradicted.invalid.orders);
}

TEST_F(ReceiverRules, AnotherControllersFramesAreNoticed) {
  SendCounter counter;
  EXPECT_TRUE(take({send(WheelCommand{}, counter)}).second_controller);
  EXPECT_TRUE(take({send(Status{}, counter)}).second_controller);
  EXPECT_FALSE(take({pack(Heartbeat{})}).second_controller);
}

TEST_F(ReceiverRules, EachKindOfWrongFrameIsCountedUpTo255) {
  Frame wrong_length = send(EmergencyStop{}, stop);
  wrong_length.length = 3;
  Frame wrong_crc = send(EmergencyStop{}, stop);
  wrong_crc.data[0] ^= 1U;
  Frame out_of_range = pack(WheelState{});
  out_of_range.data[3] = 0x7F;
  protect(out_of_range, layout<WheelState>.info.data_ids, 0);
  for (int i = 1; i <= 300; ++i) {
    take({wrong_length, wrong_crc, out_of_range});
    take({picture_of_ball()});
    pose = ball = {};
    const std::int32_t count = std::min(i, 255);
    EXPECT_EQ(receiver.ignored().wrong_length, count);
    EXPECT_EQ(receiver.ignored().wrong_crc, count);
    EXPECT_EQ(receiver.ignored().out_of_range, count);
    EXPECT_EQ(receiver.ignored().wrong_counter, count) << "a repeated picture";
  }
}

}  // namespace
}  // namespace striker::can

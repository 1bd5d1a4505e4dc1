// SPDX-License-Identifier: Apache-2.0
// Every protected frame that reaches the controller, broken in every way: ignored whole, and counted.
#include <gtest/gtest.h>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

// Steps two copies of an armed controller, one with the bad frame and one without: only the count may differ.
template <class Message>
void expect_ignored(const NodeRig& armed, const can::Frame& bad, std::int32_t can::IgnoredFrames::*counter,
                    const char* what) {
  NodeRig with = armed;
  NodeRig without = armed;
  with.extra.push_back(bad);
  const std::int32_t before = with.node.node().ignored().*counter;
  for (int i = 0; i < 120; ++i) {
    with.tick();
    without.tick();
    ASSERT_EQ(can::pack(with.command), can::pack(without.command))
        << can::layout<Message>.info.name << " " << what;
  }
  EXPECT_EQ(with.node.node().ignored().*counter, before + 1) << can::layout<Message>.info.name << " " << what;
  EXPECT_EQ(with.state(), without.state());
}

template <class Message>
void expect_every_fault_ignored(const NodeRig& armed, Message message) {
  // Any counter does for a first frame of its kind; a running one needs the next: try them all.
  can::SendCounter sender;
  can::Frame good{};
  for (std::uint8_t counter = 0; counter < can::counter_modulus; ++counter) {
    sender.next = counter;
    NodeRig trial = armed;
    good = can::send(message, sender);
    trial.extra.push_back(good);
    trial.tick();
    if (trial.node.node().ignored().wrong_counter == armed.node.node().ignored().wrong_counter) {
      break;
    }
  }
  can::Frame wrong_crc = good;
  wrong_crc.data[0] ^= 0x01U;
  expect_ignored<Message>(armed, wrong_crc, &can::IgnoredFrames::wrong_crc, "wrong CRC");
  can::Frame short_frame = good;
  --short_frame.length;
  expect_ignored<Message>(armed, short_frame, &can::IgnoredFrames::wrong_length, "short");
}

TEST(FrameFault, WrongCrcAndLengthAreIgnoredWholeAndCounted) {
  NodeRig rig;
  rig.arm();
  while (rig.now() % 50 != 10) {
    rig.tick();
  }
  expect_every_fault_ignored(rig, can::EmergencyStop{});
  expect_every_fault_ignored(rig, can::ModeCommand{.mode = static_cast<std::int32_t>(can::Mode::disarm)});
  expect_every_fault_ignored(rig, can::WheelState{.left_mm_s = 8000, .right_mm_s = 8000});
  expect_every_fault_ignored(rig, can::VisionPose{.frame = 9, .x_quarter_mm = 30000});
  expect_every_fault_ignored(rig, can::VisionBall{.frame = 9, .x_quarter_mm = 30000});
  expect_every_fault_ignored(rig, can::WheelOrder{.left_mm_s = 500, .right_mm_s = 500});
  expect_every_fault_ignored(rig, can::MotionOrder{.number = 1});
}

TEST(FrameFault, ARepeatedCounterIsIgnoredAndCounted) {
  NodeRig rig;
  rig.arm();
  expect_ignored<can::WheelState>(rig, rig.delivered.front(), &can::IgnoredFrames::wrong_counter, "repeated");
}

TEST(FrameFault, AnOutOfRangeValueIsIgnoredAndCounted) {
  NodeRig rig;
  rig.arm();
  can::Frame mode = can::pack(can::ModeCommand{});
  mode.data[1] = 0x70U;  // mode 7
  can::protect(mode, can::layout<can::ModeCommand>.info.data_ids, 3);
  expect_ignored<can::ModeCommand>(rig, mode, &can::IgnoredFrames::out_of_range, "out of range");
}

TEST(FrameFault, AnEmergencyStopOfAnySourceStops) {
  for (std::int32_t source = 0; source < 16; ++source) {
    NodeRig rig;
    rig.arm();
    can::SendCounter counter;
    rig.extra.push_back(can::send(can::EmergencyStop{.source = source}, counter));
    rig.tick();
    EXPECT_EQ(rig.fault(), core::Fault::emergency_stop) << source;
    EXPECT_FALSE(rig.torque());
  }
}

TEST(FrameFault, AnIgnoredWheelStateDoesNotFeedItsWatchdog) {
  NodeRig rig;
  rig.arm();
  rig.send_wheels = false;
  can::SendCounter counter;
  for (int i = 0; i < 21; ++i) {
    can::Frame bad = can::send(can::WheelState{}, counter);
    bad.data[0] ^= 0x80U;
    rig.extra.push_back(bad);
    rig.tick();
  }
  EXPECT_EQ(rig.fault(), core::Fault::wheel_state_invalid) << "they come, and are wrong";
}

TEST(FrameFault, CountsStayAt255) {
  NodeRig rig;
  can::Frame bad = can::pack(can::EmergencyStop{});
  bad.data[0] ^= 0xFFU;
  for (int i = 0; i < 300; ++i) {
    rig.extra.push_back(bad);
    rig.tick();
  }
  EXPECT_EQ(rig.node.node().ignored().wrong_crc, 255);
}

}  // namespace
}  // namespace striker::loop

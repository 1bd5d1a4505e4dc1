// SPDX-License-Identifier: Apache-2.0
// Nothing leaves a node but by its gate, and what the gate stopped is told to the node.
#include "firmware/loop/gated_node.hpp"

#include <gtest/gtest.h>

#include "firmware/can/codec.hpp"
#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/loop/controller_node.hpp"

namespace striker::loop {
namespace {

// Wants to move in every tick, whoever consents.
struct Eager {
  using Drives = can::StrikerDrives;

  Eager(const core::RobotProfile& /*robot*/, std::uint32_t /*seed*/) {}

  void step(const Tick& /*tick*/, const GateReport& gate, can::FrameList& frames) {
    told_of_blocked = gate.has_blocked;
    frames.clear();
    frames.add(can::send(can::WheelCommand{.left_torque_mNm = 50, .right_torque_mNm = 50}, counter));
  }

  can::SendCounter counter;
  bool told_of_blocked = false;
};

TEST(GatedNode, ANodeThatMovesWithoutConsentIsStoppedAndTold) {
  GatedNode<Eager> node(core::profile_of(core::forward));
  can::FrameList frames;
  for (std::uint32_t tick = 0; tick < 400; ++tick) {
    node.step({.number = tick}, frames);
    for (const can::Frame& frame : frames.frames()) {
      can::WheelCommand command;
      ASSERT_EQ(can::unpack(frame, command), can::Verdict::accepted);
      ASSERT_EQ(command.left_torque_mNm, 0);
      ASSERT_EQ(command.right_torque_mNm, 0);
    }
  }
  EXPECT_TRUE(node.node().told_of_blocked);
}

}  // namespace
}  // namespace striker::loop

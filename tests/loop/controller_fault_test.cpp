// SPDX-License-Identifier: Apache-2.0
// What the controller does when its inputs stop, or an operator stops it.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

using can::Mode;
using core::Fault;
using core::State;

TEST(ControllerFault, BootsThroughItsSelfTestAndNeverMovesUnarmed) {
  NodeRig rig;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    EXPECT_FALSE(rig.torque());
  }
  EXPECT_EQ(rig.state(), State::standby);
}

TEST(ControllerFault, ArmingIsRefusedWithoutTwoPictures) {
  NodeRig rig;
  rig.send_vision = false;
  rig.run(160);
  rig.mode(Mode::arm);
  rig.run(10);
  EXPECT_EQ(rig.state(), State::standby);
}

TEST(ControllerFault, ArmingIsRefusedUntilTwoPicturesAfterADisarm) {
  NodeRig rig;
  rig.arm();
  rig.mode(Mode::disarm);
  rig.tick();
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.state(), State::standby);
  rig.run(100);
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.state(), State::active);
}

TEST(ControllerFault, LostVisionStopsWithinItsTimeout) {
  NodeRig rig;
  rig.arm();
  rig.send_vision = false;
  rig.run(151);
  EXPECT_EQ(rig.fault(), Fault::vision_lost);
  EXPECT_FALSE(rig.torque());
}

TEST(ControllerFault, LostWheelStatesStopWithinTheirTimeout) {
  NodeRig rig;
  rig.arm();
  rig.send_wheels = false;
  rig.run(21);
  EXPECT_EQ(rig.fault(), Fault::wheel_state_lost);
  EXPECT_FALSE(rig.torque());
}

TEST(ControllerFault, OneLostPictureIsLedOver) {
  NodeRig rig;
  rig.arm();
  const auto before = rig.decision->number;
  while (rig.now() % 50 != 1) {
    rig.tick();
  }
  rig.send_vision = false;
  rig.run(60);
  EXPECT_EQ(rig.decision->extrapolated, 1);
  rig.send_vision = true;
  rig.run(50);
  EXPECT_EQ(rig.decision->extrapolated, 0);
  EXPECT_EQ(rig.state(), State::active);
  EXPECT_GE(rig.decision->number, before + 2);
}

TEST(ControllerFault, AnEmergencyStopTakesTheTorqueInItsOwnTick) {
  NodeRig rig;
  rig.arm();
  rig.stop();
  rig.tick();
  EXPECT_FALSE(rig.torque());
  EXPECT_EQ(rig.fault(), Fault::emergency_stop);
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.state(), State::fault) << "the stop still holds";
  rig.run(core::stop_hold_ticks);
  rig.mode(Mode::arm);
  rig.run(5);
  EXPECT_EQ(rig.state(), State::fault) << "arming does not clear";
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.state(), State::standby);
}

TEST(ControllerFault, ARunawayWheelIsNotDrivenFurther) {
  NodeRig rig;
  rig.arm();
  bool moved = false;
  for (int i = 0; i < 200 && rig.state() == State::active; ++i) {
    rig.wheels = {.left_mm_s = 4000, .right_mm_s = -4000};
    rig.tick();
    moved = moved || rig.torque();
    // Braking is all that may pass.
    EXPECT_LE(rig.command.left_torque_mNm, 0);
    EXPECT_GE(rig.command.right_torque_mNm, 0);
  }
  EXPECT_TRUE(moved || rig.state() == State::fault);
}

TEST(ControllerFault, APortsFaultPutsOutItsReportAndTorqueZero) {
  NodeRig rig;
  rig.arm();
  rig.answer({.number = rig.now() - 1, .port_faults = core::set_of(Fault::sync_lost)});
  ASSERT_TRUE(can::is<can::FaultReport>(rig.frames().front()));
  EXPECT_FALSE(rig.torque());
  EXPECT_EQ(rig.command.left_set_point_2mm_s, 0);
  EXPECT_EQ(rig.fault(), Fault::sync_lost);
}

// In the tick of the fault itself: no torque goes out that does not know of it, and no report that was due is
// lost.
TEST(ControllerFault, APortsFaultIsInTheStepThatItConcerns) {
  NodeRig rig;
  rig.arm();
  rig.run(30);
  ASSERT_TRUE(rig.torque());
  rig.port_faults = core::set_of(Fault::overrun);
  rig.tick();
  EXPECT_FALSE(rig.torque());
  EXPECT_EQ(rig.fault(), Fault::overrun);
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.state(), State::fault) << "the cause lasts";
  rig.port_faults = 0;
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.state(), State::standby);
}

// However soon it comes after another one.
TEST(ControllerFault, EveryNewFaultIsReportedInItsTick) {
  NodeRig rig;
  rig.arm();
  for (const Fault fault : {Fault::overrun, Fault::bus_off, Fault::overrun}) {
    rig.port_faults = core::set_of(fault);
    rig.tick();
    EXPECT_TRUE(std::any_of(rig.frames().begin(), rig.frames().end(), can::is<can::FaultReport>));
    rig.port_faults = 0;
    rig.run(10);
    rig.mode(Mode::clear);
    rig.tick();
    ASSERT_EQ(rig.state(), State::standby);
  }
}

// A port's stop is a disarm in every respect: nothing from before it counts for the next arming.
TEST(ControllerFault, AfterAPortsStopArmingWaitsForTwoNewPictures) {
  NodeRig rig;
  rig.arm();
  rig.answer({.number = rig.now() - 1, .stop = true});
  EXPECT_EQ(rig.state(), State::standby);
  EXPECT_FALSE(rig.torque());
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.state(), State::standby);
  rig.run(100);
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.state(), State::active);
}

TEST(Node, ACopyGoesOnAloneWithTheSameAnswers) {
  NodeRig rig;
  rig.arm();
  NodeRig copy = rig;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    copy.tick();
    const auto a = rig.frames();
    const auto b = copy.frames();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

TEST(Node, TenInOneProcessDoNotDisturbEachOther) {
  NodeRig alone;
  alone.arm();
  alone.run(300);
  std::vector<NodeRig> ten(10);
  for (std::uint32_t i = 0; i < 160; ++i) {
    for (NodeRig& rig : ten) {
      rig.tick();
    }
  }
  for (NodeRig& rig : ten) {
    rig.mode(Mode::arm);
  }
  for (std::uint32_t i = 0; i < 351; ++i) {
    for (NodeRig& rig : ten) {
      rig.tick();
    }
  }
  for (const NodeRig& rig : ten) {
    EXPECT_EQ(rig.command.left_torque_mNm, alone.command.left_torque_mNm);
    EXPECT_EQ(rig.decision->number, alone.decision->number);
  }
}

// A policy that knows the left side only decides on the right as on the left.
TEST(ControllerMirror, BothSidesAreTheSame) {
  for (const std::int32_t y : {400, 2000, 6000}) {
    NodeRig left;
    NodeRig right;
    left.ball_y_quarter_mm = y;
    right.ball_y_quarter_mm = -y;
    left.arm();
    right.arm();
    for (int i = 0; i < 20; ++i) {
      left.run(50);
      right.run(50);
      ASSERT_EQ(left.decision->number, right.decision->number);
      ASSERT_EQ(left.decision->action, right.decision->action);
      ASSERT_EQ(left.command.left_set_point_2mm_s, right.command.right_set_point_2mm_s);
      const auto& a = left.node.controller().pilot().inputs();
      const auto& b = right.node.controller().pilot().inputs();
      for (std::size_t k = 0; k < a.size(); ++k) {
        // The CORDIC rounds both sides apart: by 1/8192 of a distance, by a count or two of the rest.
        const bool distance = BuiltInPilot::state[k].element <= policy::StateElement::ball_y;
        ASSERT_NEAR(a[k], b[k], distance ? 300 : 4) << k;
      }
    }
  }
}

}  // namespace
}  // namespace striker::loop

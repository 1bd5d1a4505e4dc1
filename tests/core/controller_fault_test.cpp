// What the controller does when its inputs stop, or an operator stops it.
#include <gtest/gtest.h>

#include "tests/core/controller_rig.hpp"

namespace striker::core {
namespace {

using can::Fault;
using can::Mode;
using can::State;

TEST(ControllerFault, BootsThroughItsSelfTestAndNeverMovesUnarmed) {
  ControllerRig rig;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    EXPECT_FALSE(rig.torque());
  }
  EXPECT_EQ(rig.controller.state(), State::standby);
}

TEST(ControllerFault, ArmingIsRefusedWithoutTwoPictures) {
  ControllerRig rig;
  rig.send_vision = false;
  rig.run(160);
  rig.mode(Mode::arm);
  rig.run(10);
  EXPECT_EQ(rig.controller.state(), State::standby);
}

TEST(ControllerFault, ArmingIsRefusedUntilTwoPicturesAfterADisarm) {
  ControllerRig rig;
  rig.arm();
  rig.mode(Mode::disarm);
  rig.tick();
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.controller.state(), State::standby);
  rig.run(100);
  rig.mode(Mode::arm);
  rig.tick();
  EXPECT_EQ(rig.controller.state(), State::active);
}

TEST(ControllerFault, LostVisionStopsWithinItsTimeout) {
  ControllerRig rig;
  rig.arm();
  rig.send_vision = false;
  rig.run(151);
  EXPECT_EQ(rig.controller.fault(), Fault::vision_lost);
  EXPECT_FALSE(rig.torque());
}

TEST(ControllerFault, LostWheelStatesStopWithinTheirTimeout) {
  ControllerRig rig;
  rig.arm();
  rig.send_wheels = false;
  rig.run(21);
  EXPECT_EQ(rig.controller.fault(), Fault::wheel_state_lost);
  EXPECT_FALSE(rig.torque());
}

TEST(ControllerFault, OneLostPictureIsLedOver) {
  ControllerRig rig;
  rig.arm();
  const auto before = rig.controller.last_decision().number;
  while (rig.now() % 50 != 1) {
    rig.tick();
  }
  rig.send_vision = false;
  rig.run(60);
  EXPECT_TRUE(rig.controller.last_decision().extrapolated);
  rig.send_vision = true;
  rig.run(50);
  EXPECT_FALSE(rig.controller.last_decision().extrapolated);
  EXPECT_EQ(rig.controller.state(), State::active);
  EXPECT_GE(rig.controller.last_decision().number, before + 2);
}

TEST(ControllerFault, AnEmergencyStopTakesTheTorqueInItsOwnTick) {
  ControllerRig rig;
  rig.arm();
  rig.stop();
  rig.tick();
  EXPECT_FALSE(rig.torque());
  EXPECT_EQ(rig.controller.fault(), Fault::emergency_stop);
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.controller.state(), State::fault) << "the stop still holds";
  rig.run(event_memory_ticks);
  rig.mode(Mode::arm);
  rig.run(5);
  EXPECT_EQ(rig.controller.state(), State::fault) << "arming does not clear";
  rig.mode(Mode::clear);
  rig.tick();
  EXPECT_EQ(rig.controller.state(), State::standby);
}

TEST(ControllerFault, ARunawayWheelIsNotDrivenFurther) {
  ControllerRig rig;
  rig.arm();
  bool moved = false;
  for (int i = 0; i < 200 && rig.controller.state() == State::active; ++i) {
    rig.wheels = {.left_mm_s = 4000, .right_mm_s = -4000};
    rig.tick();
    moved = moved || rig.torque();
    // Braking is all that may pass.
    EXPECT_LE(rig.command.left_torque_mNm, 0);
    EXPECT_GE(rig.command.right_torque_mNm, 0);
  }
  EXPECT_TRUE(moved || rig.controller.fault() == Fault::overspeed);
}

TEST(ControllerFault, APortsFaultPutsOutItsReportAndTorqueZero) {
  ControllerRig rig;
  rig.arm();
  Outputs outputs;
  rig.controller.enter_fault(Fault::sync_lost, outputs);
  ASSERT_TRUE(can::is<can::FaultReport>(outputs.frames().front()));
  can::WheelCommand command;
  ASSERT_EQ(can::unpack(outputs.frames().back(), command), can::Verdict::accepted);
  EXPECT_EQ(command.left_torque_mNm, 0);
  EXPECT_EQ(command.left_set_point_2mm_s, 0);
  EXPECT_EQ(rig.controller.fault(), Fault::sync_lost);
}

TEST(Controller, ACopyGoesOnAloneWithTheSameAnswers) {
  ControllerRig rig;
  rig.arm();
  ControllerRig copy = rig;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    copy.tick();
    const auto a = rig.outputs.frames();
    const auto b = copy.outputs.frames();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

TEST(Controller, TenInOneProcessDoNotDisturbEachOther) {
  ControllerRig alone;
  alone.arm();
  alone.run(300);
  std::vector<ControllerRig> ten(10);
  for (std::uint32_t i = 0; i < 160; ++i) {
    for (ControllerRig& rig : ten) {
      rig.tick();
    }
  }
  for (ControllerRig& rig : ten) {
    rig.mode(Mode::arm);
  }
  for (std::uint32_t i = 0; i < 351; ++i) {
    for (ControllerRig& rig : ten) {
      rig.tick();
    }
  }
  for (const ControllerRig& rig : ten) {
    EXPECT_EQ(rig.command.left_torque_mNm, alone.command.left_torque_mNm);
    EXPECT_EQ(rig.controller.last_decision().number, alone.controller.last_decision().number);
  }
}

// A policy that knows the left side only decides on the right as on the left.
TEST(ControllerMirror, BothSidesAreTheSame) {
  for (const std::int32_t y : {400, 2000, 6000}) {
    ControllerRig left;
    ControllerRig right;
    left.ball_y_quarter_mm = y;
    right.ball_y_quarter_mm = -y;
    left.arm();
    right.arm();
    for (int i = 0; i < 20; ++i) {
      left.run(50);
      right.run(50);
      const DecisionRecord& a = left.controller.last_decision();
      const DecisionRecord& b = right.controller.last_decision();
      ASSERT_EQ(a.number, b.number);
      ASSERT_EQ(a.action, b.action);
      ASSERT_EQ(left.command.left_set_point_2mm_s, right.command.right_set_point_2mm_s);
      for (std::size_t k = 0; k < policy_inputs().size(); ++k) {
        // The CORDIC rounds both sides apart: by 1/8192 of a distance, by a count or two of the rest.
        const bool distance = policy_inputs()[k].element <= policy::StateElement::ball_y;
        ASSERT_NEAR(a.inputs[k], b.inputs[k], distance ? 300 : 4) << k;
      }
    }
  }
}

}  // namespace
}  // namespace striker::core

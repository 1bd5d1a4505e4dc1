// SPDX-License-Identifier: Apache-2.0
// The command gate with drives of other makes: what goes out is safe, whatever the controller wants.
#include <gtest/gtest.h>

#include "firmware/safety/command_gate.hpp"
#include "tests/drives/drive_rig.hpp"

namespace striker::safety {
namespace {

constexpr std::int32_t arm = static_cast<std::int32_t>(can::Mode::arm);

// A drive's frame that tells speed 0, and one that tells whether it is enabled.
template <class Drives>
struct Told;

template <can::DriveWiring wiring>
struct Told<can::OdriveDrives<wiring>> {
  using Drives = can::OdriveDrives<wiring>;
  static can::Frame speed(std::size_t wheel) {
    return {.id = Drives::id(wheel, can::odrive::get_encoder_estimates), .length = 8};
  }
  static can::Frame state(std::size_t wheel, bool enabled) {
    can::Frame frame = {.id = Drives::id(wheel, can::odrive::heartbeat), .length = 8};
    frame.data[4] = enabled ? 8 : 1;
    return frame;
  }
  static can::Frame enabling(std::size_t wheel) {
    can::Frame frame = {.id = Drives::id(wheel, can::odrive::set_axis_state), .length = 4};
    frame.data[0] = 8;
    return frame;
  }
  static can::Frame command(std::size_t wheel, std::int32_t torque_mNm) {
    can::Frame frame = {.id = Drives::id(wheel, can::odrive::set_input_torque), .length = 4};
    core::DriveCommand both = {.torque = {torque_mNm, torque_mNm}, .set_point = {}};
    Drives::recode(frame, both);
    return frame;
  }
};

template <can::DriveWiring wiring>
struct Told<can::Cia402Drives<wiring>> {
  using Drives = can::Cia402Drives<wiring>;
  static can::Frame state(std::size_t wheel, bool enabled) {
    can::Frame frame = {.id = Drives::id(wheel, can::cia402::tpdo1), .length = 6};
    frame.data[0] = enabled ? 0x37 : 0x31;
    return frame;
  }
  static can::Frame speed(std::size_t wheel) { return state(wheel, true); }
  static can::Frame enabling(std::size_t wheel) { return command(wheel, 0); }
  static can::Frame command(std::size_t wheel, std::int32_t torque_mNm) {
    can::Frame frame = {.id = Drives::id(wheel, can::cia402::rpdo1), .length = 5};
    frame.data[0] = 0x0F;
    core::DriveCommand both = {.torque = {torque_mNm, torque_mNm}, .set_point = {}};
    Drives::recode(frame, both);
    return frame;
  }
};

template <class Drives>
class ForeignGate : public testing::Test {
 protected:
  using Says = Told<Drives>;
  CommandGate<Drives> gate{{.torque_mNm = 400, .slew_mNm = 300, .set_point_mm_s = 2000}};
  std::uint32_t tick = 1000;
  bool sends_drives = true;
  bool sends_pictures = true;

  void feed(std::uint32_t ticks = 1) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      for (const std::size_t wheel : {can::left_wheel, can::right_wheel}) {
        if (sends_drives) {
          receive(Says::speed(wheel));
          receive(Says::state(wheel, true));
        }
      }
      if (sends_pictures) {
        receive(can::send(can::VisionPose{}, pose_));
        receive(can::send(can::VisionBall{}, ball_));
      }
      ++tick;
    }
  }
  void receive(const can::Frame& frame) { gate.take({&frame, 1}, tick); }
  can::Frame sent(const can::Frame& frame) {
    can::FrameList frames;
    frames.add(frame);
    gate.check(frames, tick);
    return frames.frames().empty() ? can::Frame{.id = 0xFFFF} : frames.frames().front();
  }
  std::int32_t torque_of(const can::Frame& frame) {
    const core::DriveCommand command = Drives::command_of(frame);
    return command.torque.left_mNm + command.torque.right_mNm;
  }
  std::int32_t passed(std::size_t wheel, std::int32_t torque_mNm) {
    return torque_of(sent(Says::command(wheel, torque_mNm)));
  }
  void confirm() {
    sent(can::send(can::Challenge{.mode = arm, .challenge = 77}, challenge_));
    receive(can::send(can::ModeCommand{.mode = arm, .challenge = 77}, mode_));
  }
  void drive() {
    feed(13);
    confirm();
    ASSERT_EQ(passed(can::left_wheel, 100), 100);
    ASSERT_EQ(passed(can::right_wheel, -100), -100);
  }

 private:
  can::SendCounter pose_, ball_, challenge_, mode_;
};

using AllForeign =
    testing::Types<can::OdriveDrives<sil::odrive_wiring>, can::Cia402Drives<sil::cia402_wiring>>;
TYPED_TEST_SUITE(ForeignGate, AllForeign);

TYPED_TEST(ForeignGate, NothingMovesOrIsEnabledUnlessArmed) {
  this->feed(13);
  EXPECT_FALSE(TypeParam::enables(this->sent(TestFixture::Says::enabling(can::left_wheel))));
  EXPECT_EQ(this->passed(can::left_wheel, 100), 0);
  EXPECT_EQ(this->passed(can::right_wheel, -1), 0);
  EXPECT_TRUE(this->gate.has_blocked());
}

TYPED_TEST(ForeignGate, ArmedItPassesAsItIs) {
  this->drive();
  EXPECT_TRUE(TypeParam::enables(this->sent(TestFixture::Says::enabling(can::left_wheel))));
  const can::Frame frame = TestFixture::Says::command(can::right_wheel, 77);
  EXPECT_EQ(this->sent(frame), frame);
  EXPECT_FALSE(this->gate.has_blocked());
}

TYPED_TEST(ForeignGate, LimitsHoldForEachWheelByItself) {
  this->drive();  // 100 and -100 now
  EXPECT_LE(this->passed(can::left_wheel, 500), 400);
  EXPECT_GE(this->passed(can::left_wheel, 500), 395) << "a per mille is 0.4 mNm here";
  EXPECT_EQ(this->gate.active_limits(), can::limit_torque);
  EXPECT_EQ(this->passed(can::right_wheel, 200), 200) << "its own slew, from -100";
  EXPECT_EQ(this->passed(can::right_wheel, -400), -100) << "300 at once";
  EXPECT_EQ(this->gate.active_limits(), can::limit_slew);
  EXPECT_GE(this->passed(can::left_wheel, 380), 380) << "the other's frames do not count";
  EXPECT_EQ(this->gate.active_limits(), 0U);
  EXPECT_FALSE(this->gate.has_blocked());
}

TYPED_TEST(ForeignGate, OldSpeedsBlock) {
  this->drive();
  this->sends_drives = false;
  this->feed(wheels_limit_ticks - 1);
  EXPECT_EQ(this->passed(can::left_wheel, 50), 50);
  this->feed();
  EXPECT_EQ(this->passed(can::left_wheel, 50), 0);
}

TYPED_TEST(ForeignGate, OneDriveThatIsNotEnabledBlocks) {
  this->drive();
  this->receive(TestFixture::Says::state(can::right_wheel, false));
  EXPECT_EQ(this->passed(can::left_wheel, 50), 0);
  EXPECT_TRUE(this->gate.has_blocked());
}

TYPED_TEST(ForeignGate, LostPicturesBlock) {
  this->drive();
  this->sends_pictures = false;
  this->feed(vision_limit_ticks + 2);
  EXPECT_EQ(this->passed(can::left_wheel, 50), 0);
}

// Every identifier, length and first byte: only what `put` makes leaves.
TYPED_TEST(ForeignGate, WhatIsNoFrameOfItsDrivesDoesNotLeave) {
  this->drive();
  for (std::uint16_t id = 0; id <= 0x7FF; ++id) {
    for (std::uint8_t length = 0; length <= 8; ++length) {
      const can::Frame frame = {.id = id, .length = length, .data = {0x02, 0xFF, 0xC0, 0x7F, 0x01}};
      const bool is_own = can::any_layout([&](const auto& message) { return message.info.id == id; });
      if (!is_own && may_send<TypeParam>(frame)) {
        EXPECT_TRUE(std::find(TypeParam::sends.begin(), TypeParam::sends.end(), id) !=
                    TypeParam::sends.end());
        EXPECT_FALSE(id == 0x00E && length != 4) << "Set_Input_Torque";
        EXPECT_FALSE(id == 0x080 && length != 0) << "SYNC";
        EXPECT_FALSE(id == 0x000) << "NMT: start alone, and of its own nodes";
        EXPECT_FALSE(id == 0x007 || id == 0x027) << "a state of 2 is a calibration";
      }
    }
  }
  const can::Frame little = {.id = 0x00E, .length = 4, .data = {0xAC, 0xC5, 0x27, 0x37}};  // 0.01 mNm
  EXPECT_FALSE(may_send<can::OdriveDrives<sil::odrive_wiring>>(little)) << "it would look like none";
  can::Frame nan = {.id = 0x00E, .length = 4, .data = {0, 0, 0xC0, 0x7F}};
  EXPECT_FALSE(may_send<can::OdriveDrives<sil::odrive_wiring>>(nan));
}

}  // namespace
}  // namespace striker::safety

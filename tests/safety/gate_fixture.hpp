// SPDX-License-Identifier: Apache-2.0
// A command gate by itself, with honest inputs that can be withheld.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/safety/command_gate.hpp"

namespace striker::safety {

inline constexpr std::int32_t disarm = static_cast<std::int32_t>(can::Mode::disarm);
inline constexpr std::int32_t renew = static_cast<std::int32_t>(can::Mode::renew);
inline constexpr std::int32_t arm = static_cast<std::int32_t>(can::Mode::arm);
inline constexpr std::int32_t clear = static_cast<std::int32_t>(can::Mode::clear);
inline constexpr can::WheelCommand some_command = {.left_torque_mNm = 100, .right_torque_mNm = -100};

class GateRules : public testing::Test {
 protected:
  CommandGate<can::StrikerDrives> gate{{.torque_mNm = 400, .slew_mNm = 300, .set_point_mm_s = 2000}};
  std::uint32_t tick = 1000;
  bool sends_wheels = true;
  bool sends_poses = true;
  bool sends_balls = true;

  // A tick in which the inputs come that are not withheld.
  void feed() {
    if (sends_wheels) {
      receive(can::send(can::WheelState{}, wheels_));
    }
    if (sends_poses) {
      receive(can::send(can::VisionPose{}, pose_));
    }
    if (sends_balls) {
      receive(can::send(can::VisionBall{}, ball_));
    }
    ++tick;
  }
  void feed(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      feed();
    }
  }
  // One that was sent, and that nobody received.
  void lose_wheels() { static_cast<void>(can::send(can::WheelState{}, wheels_)); }
  void lose_pose() { static_cast<void>(can::send(can::VisionPose{}, pose_)); }
  void lose_ball() { static_cast<void>(can::send(can::VisionBall{}, ball_)); }
  void lose_order() { static_cast<void>(can::send(can::ModeCommand{}, mode_)); }
  void receive(const can::Frame& frame) { gate.take({&frame, 1}, tick); }

  can::FrameList send(const can::Frame& frame) {
    can::FrameList frames;
    frames.add(frame);
    gate.check(frames, tick);
    return frames;
  }
  can::WheelCommand command(const can::WheelCommand& wanted) {
    can::WheelCommand passed;
    EXPECT_EQ(can::receive(send(can::send(wanted, command_)).frames().front(), passed),
              can::Verdict::accepted);
    return passed;
  }
  bool moves() { return command(some_command).left_torque_mNm != 0; }

  void challenge(std::int32_t mode, std::int32_t number) {
    send(can::send(can::Challenge{.mode = mode, .challenge = number}, challenge_));
  }
  void order(std::int32_t mode, std::int32_t number) {
    last_order_ = can::send(can::ModeCommand{.mode = mode, .challenge = number}, mode_);
    receive(last_order_);
  }
  void repeat_order() { receive(last_order_); }
  void confirm(std::int32_t mode) {
    challenge(mode, 77);
    order(mode, 77);
  }
  void drive() {
    feed(13);
    confirm(arm);
    ASSERT_TRUE(moves());
  }

 private:
  can::Frame last_order_;
  can::SendCounter wheels_, pose_, ball_, challenge_, command_, mode_;
};

}  // namespace striker::safety

// SPDX-License-Identifier: Apache-2.0
// A hostile bus: frames lost, repeated, corrupted, late, with random commands between. On every tick: no
// torque without a valid, fresh, armed cause, by the test's own account of what was delivered whole.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/loop/node_rig.hpp"

namespace striker::loop {
namespace {

class HostileBus {
 public:
  explicit HostileBus(std::uint32_t seed) : random_(seed) {}

  // Loses, repeats or breaks frames; what comes out whole is delivered.
  std::vector<can::Frame> pass(const std::vector<can::Frame>& sent) {
    std::vector<can::Frame> delivered;
    for (can::Frame frame : sent) {
      const double luck = uniform_(random_);
      if (luck < 0.05) {
        continue;
      }
      if (luck < 0.10) {
        frame.data[random_() % 8] ^= static_cast<std::uint8_t>(1U << (random_() % 8));
      }
      delivered.push_back(frame);
      if (luck > 0.97) {
        delivered.push_back(frame);
      }
    }
    return delivered;
  }

  double uniform() { return uniform_(random_); }
  std::mt19937& random() { return random_; }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

// Delivery times that would be fresh at best: any frame of the kind with a right CRC and length counts.
struct Account {
  std::uint32_t vision = 0;
  std::uint32_t wheels = 0;

  void take(std::uint32_t now, const std::vector<can::Frame>& frames) {
    for (const can::Frame& frame : frames) {
      can::ReceiveCounter any;
      can::VisionBall ball;
      can::WheelState state;
      if (can::is<can::VisionBall>(frame) && can::receive(frame, any, ball) == can::Verdict::accepted) {
        vision = now;
      } else if (can::is<can::WheelState>(frame) &&
                 can::receive(frame, any, state) == can::Verdict::accepted) {
        wheels = now;
      }
    }
  }
};

void run_hostile(std::uint32_t seed, std::uint64_t& driven_ticks) {
  HostileBus bus(seed);
  NodeRig rig;
  Account account;
  can::SendCounter pose_counter;
  can::SendCounter ball_counter;
  can::SendCounter wheel_counter;
  can::SendCounter mode_counter;
  can::SendCounter stop_counter;
  std::uniform_int_distribution<std::int32_t> any16(-32768, 32767);
  std::uniform_int_distribution<std::int32_t> speed(-3200, 3200);
  bool vision_on = true;
  bool wheels_on = true;
  for (std::uint32_t now = 0; now < 20'000; ++now) {
    std::vector<can::Frame> sent;
    vision_on = bus.uniform() < 0.0005 ? !vision_on : vision_on;
    wheels_on = bus.uniform() < 0.0005 ? !wheels_on : wheels_on || bus.uniform() < 0.01;
    const std::uint64_t jitter = bus.random()() % 3;
    if (vision_on && (now + jitter) % 50 <= 1) {
      const auto frame = static_cast<std::int32_t>(now / 50 % 16);
      sent.push_back(
          can::send(can::VisionPose{frame, any16(bus.random()), any16(bus.random()), any16(bus.random())},
                    pose_counter));
      sent.push_back(
          can::send(can::VisionBall{frame, any16(bus.random()), any16(bus.random())}, ball_counter));
    }
    if (wheels_on) {
      sent.push_back(can::send(can::WheelState{0, speed(bus.random()), speed(bus.random())}, wheel_counter));
    }
    if (bus.uniform() < 0.05) {
      const std::array modes = {can::Mode::arm, can::Mode::arm, can::Mode::clear, can::Mode::disarm};
      sent.push_back(
          can::send(can::ModeCommand{static_cast<std::int32_t>(modes[bus.random()() % 4])}, mode_counter));
    }
    if (bus.uniform() < 0.0003) {
      sent.push_back(can::send(can::EmergencyStop{}, stop_counter));
    }
    const auto delivered = bus.pass(sent);
    account.take(now, delivered);
    rig.step(delivered);
    const bool moves =
        rig.torque() || rig.command.left_set_point_2mm_s != 0 || rig.command.right_set_point_2mm_s != 0;
    if (moves) {
      ++driven_ticks;
      ASSERT_EQ(rig.state(), core::State::active);
      ASSERT_LE(now - account.vision, 150U);
      ASSERT_LE(now - account.wheels, 20U);
      ASSERT_LE(std::abs(rig.command.left_torque_mNm), built_in_robot.torque_limit_mNm);
      ASSERT_LE(std::abs(rig.command.right_torque_mNm), built_in_robot.torque_limit_mNm);
      ASSERT_LE(std::abs(rig.command.left_set_point_2mm_s) * 2, built_in_robot.top_rim_speed_mm_s);
    }
  }
}

TEST(RandomBus, NoTorqueWithoutAValidFreshArmedCause) {
  std::uint64_t driven_ticks = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    run_hostile(seed, driven_ticks);
  }
  EXPECT_GT(driven_ticks, 20'000U) << "the test must see the controller drive";
}

}  // namespace
}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// A hostile bus: frames lost, repeated, corrupted, late, with random commands between. On every tick: no
// torque without a valid, fresh, armed cause, by the test's own account of what was delivered whole.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/loop/bench/node_rig.hpp"

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
      can::VisionBall ball;
      can::WheelState state;
      if (can::is<can::VisionBall>(frame) && can::receive(frame, ball) == can::Verdict::accepted) {
        vision = now;
      } else if (can::is<can::WheelState>(frame) && can::receive(frame, state) == can::Verdict::accepted) {
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
  BenchOperator operators;
  can::SendCounter stop_counter;
  // A world that wanders no faster than a world can.
  std::uniform_int_distribution<std::int32_t> step(-100, 100);
  can::VisionPose pose;
  can::VisionBall ball{.x_quarter_mm = 4000};
  can::WheelState wheels;
  bool vision_on = true;
  bool wheels_on = true;
  for (std::uint32_t now = 0; now < 20'000; ++now) {
    std::vector<can::Frame> sent;
    vision_on = bus.uniform() < 0.0005 ? !vision_on : vision_on;
    wheels_on = bus.uniform() < 0.0005 ? !wheels_on : wheels_on || bus.uniform() < 0.01;
    const std::uint64_t jitter = bus.random()() % 3;
    if (vision_on && (now + jitter) % 50 <= 1) {
      const auto frame = static_cast<std::int32_t>(now / 50 % 16);
      pose = {frame, pose.x_quarter_mm + step(bus.random()), pose.y_quarter_mm + step(bus.random()),
              step(bus.random())};
      ball = {frame, ball.x_quarter_mm + step(bus.random()), ball.y_quarter_mm + step(bus.random())};
      sent.push_back(can::send(pose, pose_counter));
      sent.push_back(can::send(ball, ball_counter));
    }
    if (wheels_on) {
      wheels = {0, step(bus.random()), step(bus.random())};
      sent.push_back(can::send(wheels, wheel_counter));
    }
    if (bus.uniform() < 0.05) {
      const std::array modes = {can::Mode::arm, can::Mode::arm, can::Mode::clear, can::Mode::renew,
                                bus.uniform() < 0.1 ? can::Mode::disarm : can::Mode::clear};
      sent.push_back(operators.command(modes[bus.random()() % modes.size()]));
    }
    if (const auto confirmation = operators.answer(rig.frames()); confirmation && bus.uniform() < 0.8) {
      sent.push_back(*confirmation);
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
  EXPECT_GT(driven_ticks, 5'000U) << "the test must see the controller drive";
}

}  // namespace
}  // namespace striker::loop

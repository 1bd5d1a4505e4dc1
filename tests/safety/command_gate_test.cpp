// SPDX-License-Identifier: Apache-2.0
// The command gate against a controller that is not to be believed: whatever it sends, nothing moves without a
// cause that the gate saw itself.
#include "firmware/safety/command_gate.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "firmware/can/drives/striker_drives.hpp"

namespace striker::safety {
namespace {

using can::Mode;
using Gate = CommandGate<can::StrikerDrives>;

constexpr GateLimits limits = {.torque_mNm = 400, .slew_mNm = 100, .set_point_mm_s = 2550};

// A controller that wants to move in every tick, and the world around the gate.
class Bench {
 public:
  bool send_wheels = true;
  bool send_vision = true;
  std::int32_t torque_mNm = 50;
  Gate gate{limits};
  can::WheelCommand passed;

  void tick(const std::vector<can::Frame>& extra = {}, const std::vector<can::Frame>& sent = {}) {
    std::vector<can::Frame> received = extra;
    if (send_wheels) {
      received.push_back(can::send(can::WheelState{}, wheels_));
    }
    if (send_vision && now_ % 50 == 0) {
      received.push_back(can::send(can::VisionPose{}, pose_));
      received.push_back(can::send(can::VisionBall{}, ball_));
    }
    can::FrameList frames;
    for (const can::Frame& frame : sent) {
      frames.add(frame);
    }
    frames.add(can::send(can::WheelCommand{.left_torque_mNm = torque_mNm,
                                           .right_torque_mNm = -torque_mNm,
                                           .left_set_point_2mm_s = torque_mNm == 0 ? 0 : 100},
                         commands_));
    gate.take(received, now_);
    gate.check(frames, now_++);
    EXPECT_EQ(can::receive(frames.frames().back(), passed), can::Verdict::accepted) << "protected, as ever";
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tick();
    }
  }
  [[nodiscard]] bool moves() const {
    return passed.left_torque_mNm != 0 || passed.right_torque_mNm != 0 || passed.left_set_point_2mm_s != 0;
  }
  can::Frame mode(Mode mode, std::int32_t challenge = 0) {
    return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                     modes_);
  }
  can::Frame challenge(Mode mode, std::int32_t challenge) {
    return can::send(can::Challenge{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                     challenges_);
  }
  // An honest operator and controller: asked, answered, confirmed.
  void consent(Mode asked) {
    tick({mode(asked)}, {challenge(asked, 4711)});
    tick({mode(asked, 4711)});
  }
  // Quiet until everything is fresh, then armed.
  void arm() {
    torque_mNm = 0;
    quiet(310);
    consent(Mode::clear);
    consent(Mode::arm);
    torque_mNm = 50;
  }
  // A controller that wants nothing.
  void quiet(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      std::vector<can::Frame> received;
      if (send_wheels) {
        received.push_back(can::send(can::WheelState{}, wheels_));
      }
      if (send_vision && now_ % 50 == 0) {
        received.push_back(can::send(can::VisionPose{}, pose_));
        received.push_back(can::send(can::VisionBall{}, ball_));
      }
      gate.take(received, now_++);
    }
  }
  [[nodiscard]] std::uint32_t now() const { return now_; }

 private:
  std::uint32_t now_ = 0;
  can::SendCounter wheels_, pose_, ball_, commands_, modes_, challenges_;
};

TEST(CommandGate, NothingMovesUnarmed) {
  Bench bench;
  for (int i = 0; i < 1'000; ++i) {
    bench.tick();
    ASSERT_FALSE(bench.moves());
  }
  EXPECT_TRUE(bench.gate.has_blocked());
  EXPECT_EQ(bench.gate.blocked(), 255U);
}

TEST(CommandGate, AConfirmedArmOpensItForHonestInputs) {
  Bench bench;
  bench.arm();
  for (int i = 0; i < 5'000; ++i) {
    bench.tick();
    ASSERT_TRUE(bench.moves()) << i;
  }
  EXPECT_FALSE(bench.gate.has_blocked());
}

TEST(CommandGate, AControllersOwnWordArmsNothing) {
  for (const bool told : {true, false}) {
    Bench bench;
    bench.quiet(310);
    if (told) {
      bench.tick({}, {bench.challenge(Mode::arm, 4711)});  // and nobody confirms it
    } else {
      bench.tick({bench.mode(Mode::arm, 4711)});  // and nobody was asked
    }
    bench.run(10);
    EXPECT_FALSE(bench.moves());
  }
}

TEST(CommandGate, ADisarmAStopAndTheControllersFaultShutIt) {
  can::SendCounter counter;
  const can::Frame stop = can::send(can::EmergencyStop{.source = 9}, counter);
  const can::Frame report = can::send(can::FaultReport{.code = 3}, counter);
  Bench bench;
  bench.arm();
  bench.tick({bench.mode(Mode::disarm)});
  EXPECT_FALSE(bench.moves());
  bench.arm();
  bench.tick({stop});
  EXPECT_FALSE(bench.moves());
  bench.arm();
  bench.tick({}, {report});
  EXPECT_FALSE(bench.moves());
  bench.run(100);
  EXPECT_FALSE(bench.moves());
}

TEST(CommandGate, AStopHoldsThroughAnArmAndARestart) {
  can::SendCounter counter;
  Bench bench;
  bench.arm();
  bench.tick({can::send(can::EmergencyStop{}, counter)});
  bench.gate.restart();
  bench.torque_mNm = 0;
  bench.consent(Mode::arm);
  bench.torque_mNm = 50;
  bench.run(10);
  EXPECT_FALSE(bench.moves());
  bench.arm();  // which clears first
  bench.tick();
  EXPECT_TRUE(bench.moves());
}

TEST(CommandGate, StaleInputsShutIt) {
  for (const bool wheels : {true, false}) {
    Bench bench;
    bench.arm();
    bench.tick();
    (wheels ? bench.send_wheels : bench.send_vision) = false;
    int moved = 0;
    for (int i = 0; i < 1'000; ++i) {
      bench.tick();
      moved += bench.moves() ? 1 : 0;
    }
    EXPECT_LE(moved, wheels ? 25 : 200);
  }
}

TEST(CommandGate, BeingArmedEndsAndIsRenewed) {
  Bench bench;
  bench.arm();
  int moved = 0;
  for (int i = 0; i < 12'000; ++i) {
    bench.tick();
    moved += bench.moves() ? 1 : 0;
  }
  EXPECT_LE(moved, static_cast<int>(armed_limit_ticks) + 2);
  Bench held;
  held.arm();
  for (int i = 0; i < 25'000; ++i) {
    held.tick(i % 5'000 == 0 ? std::vector{held.mode(Mode::renew)} : std::vector<can::Frame>{});
  }
  EXPECT_TRUE(held.moves());
}

// A bit of the gate's own memory changes by itself while a sound controller drives.
TEST(GateMemory, NoFlippedBitLeadsATorqueBeyondTheLimit) {
  Bench armed;
  armed.arm();
  armed.run(3);
  ASSERT_TRUE(armed.moves());
  for (std::size_t bit = 0; bit < 8 * sizeof(Gate); ++bit) {
    Bench bench = armed;
    std::as_writable_bytes(std::span(&bench.gate, 1))[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    for (int i = 0; i < 5; ++i) {
      bench.tick();
      ASSERT_LE(std::abs(bench.passed.left_torque_mNm), limits.torque_mNm) << "bit " << bit;
      ASSERT_LE(std::abs(bench.passed.right_torque_mNm), limits.torque_mNm) << "bit " << bit;
    }
  }
}

TEST(CommandGate, LimitsAreKeptAndToldAndAreNoFault) {
  Bench bench;
  bench.arm();
  bench.torque_mNm = 2'000;
  std::int32_t before_mNm = 0;
  for (int i = 0; i < 10; ++i) {
    bench.tick();
    EXPECT_LE(bench.passed.left_torque_mNm, limits.torque_mNm);
    EXPECT_LE(std::abs(bench.passed.left_torque_mNm - before_mNm), limits.slew_mNm);
    EXPECT_NE(bench.gate.active_limits() & (can::limit_torque | can::limit_slew), 0U);
    before_mNm = bench.passed.left_torque_mNm;
  }
  EXPECT_EQ(before_mNm, limits.torque_mNm);
  EXPECT_FALSE(bench.gate.has_blocked());
  bench.torque_mNm = 400;
  bench.run(2);
  EXPECT_EQ(bench.gate.active_limits(), 0U);
}

// Random mode commands for ever, in front of a controller that challenges itself in every tick: the gate was never shut,
// and yet, by its own account, nobody consented.
TEST(CommandGate, RandomFramesDoNotOpenIt) {
  std::mt19937 random(1);
  Bench bench;
  bench.quiet(310);
  bench.torque_mNm = 0;
  for (int i = 0; i < 200'000; ++i) {
    can::Frame frame{.id = can::layout<can::ModeCommand>.info.id, .length = 6};
    for (std::uint8_t& byte : frame.data) {
      byte = static_cast<std::uint8_t>(random());
    }
    const auto number = static_cast<std::int32_t>(random() & 0x7FFFFFFFU) | 1;
    bench.tick({frame}, {bench.challenge(Mode::arm, number)});
    if (i % 100 == 0) {
      Bench moving = bench;
      moving.torque_mNm = 50;
      moving.tick();
      ASSERT_FALSE(moving.moves()) << i;
      ASSERT_TRUE(moving.gate.has_blocked());
    }
  }
  bench.consent(Mode::arm);
  bench.torque_mNm = 50;
  bench.tick();
  EXPECT_TRUE(bench.moves()) << "an honest operator still can";
}

}  // namespace
}  // namespace striker::safety

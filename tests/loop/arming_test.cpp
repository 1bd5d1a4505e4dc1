// SPDX-License-Identifier: Apache-2.0
// What arming begins, on the wire: nothing of an earlier run is left, and nothing moves before a decision.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

using can::Mode;

TEST(Arming, MovesNothingBeforeTheFirstDecisionAlsoWhereTheWheelsRoll) {
  NodeRig rig;
  rig.wheels.left_mm_s = 500;
  rig.wheels.right_mm_s = 500;
  rig.run(160);
  rig.mode(Mode::arm);
  rig.tick();
  ASSERT_EQ(rig.state(), core::State::active);
  int waited = 0;
  while (!rig.decision && waited < 50) {
    ASSERT_FALSE(rig.torque()) << waited;
    rig.tick();
    ++waited;
  }
  EXPECT_GT(waited, 20);
  EXPECT_TRUE(rig.torque());
}

// The bench's world comes back every 8 s.
TEST(Arming, EveryTimeBeginsAnew) {
  NodeRig rig;
  std::array<std::vector<can::WheelCommand>, 2> commands;
  for (auto& run : commands) {
    while (rig.now() % 8000 != 160) {
      rig.tick();
    }
    rig.mode(Mode::arm);
    for (int tick = 0; tick < 1500; ++tick) {
      rig.tick();
      run.push_back(rig.command);
    }
    ASSERT_EQ(rig.state(), core::State::active);
    rig.mode(Mode::disarm);
    rig.tick();
    ASSERT_FALSE(rig.torque());
  }
  for (std::size_t tick = 0; tick < commands[0].size(); ++tick) {
    const can::WheelCommand& one = commands[0][tick];
    const can::WheelCommand& other = commands[1][tick];
    ASSERT_EQ(one.left_torque_mNm, other.left_torque_mNm) << tick;
    ASSERT_EQ(one.right_torque_mNm, other.right_torque_mNm) << tick;
    ASSERT_EQ(one.left_set_point_2mm_s, other.left_set_point_2mm_s) << tick;
    ASSERT_EQ(one.right_set_point_2mm_s, other.right_set_point_2mm_s) << tick;
  }
}

// The operator is dead, and something on the bus repeats what was said last.
TEST(Arming, EndsThoughOldRenewalsAreRepeatedForEver) {
  for (const std::size_t frames : {1U, 2U, 3U}) {
    NodeRig rig;
    can::SendCounter counter{.next = 5};
    std::vector<can::Frame> old;
    for (std::size_t i = 0; i < frames; ++i) {
      old.push_back(can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(Mode::renew)}, counter));
    }
    rig.arm();
    for (std::size_t second = 0; second < 21; ++second) {
      rig.extra.push_back(old[second % frames]);
      rig.run(1'000);
    }
    EXPECT_EQ(rig.fault(), core::Fault::dead_man) << frames;
  }
}

TEST(Arming, LastsAsLongAsAnOperatorRenewsIt) {
  NodeRig rig;
  rig.arm();
  for (int second = 0; second < 60; ++second) {
    rig.mode(Mode::renew);
    rig.run(1'000);
    ASSERT_EQ(rig.state(), core::State::active) << second;
  }
}

// There is nothing to clear: neither the controller nor the gate makes a fault of it.
TEST(Arming, AClearWhileDrivingChangesNothing) {
  NodeRig rig;
  rig.arm();
  rig.mode(Mode::clear);
  rig.run(100);
  EXPECT_EQ(rig.state(), core::State::active);
  EXPECT_EQ(rig.fault(), core::Fault::none);
}

}  // namespace
}  // namespace striker::loop

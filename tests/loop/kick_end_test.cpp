// SPDX-License-Identifier: Apache-2.0
// A kick ends by itself: 40 decisions of 50 ms, as the task has it, and then the robot is told to stand.
#include <gtest/gtest.h>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

constexpr std::uint32_t kick_ms = 40 * 50;

// The last Status, ticks that moved, and the tick of the first set-point.
struct Watch {
  NodeRig rig;
  can::Status status;
  std::uint32_t moved = 0;

  [[nodiscard]] bool is_told_to_move() const {
    return rig.command.left_set_point_2mm_s != 0 || rig.command.right_set_point_2mm_s != 0;
  }

  void arm() {
    while (rig.now() % 8000 != 160) {
      rig.tick();
    }
    rig.mode(can::Mode::arm);
    rig.tick();
    ASSERT_EQ(rig.state(), core::State::active);
    rig.decision.reset();
    while (!rig.decision) {
      rig.tick();
    }
    moved = is_told_to_move() ? 1 : 0;
  }

  void run(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      if (i % 1000 == 0) {
        rig.mode(can::Mode::renew);
      }
      rig.tick();
      moved += is_told_to_move() ? 1 : 0;
      for (const can::Frame& frame : rig.frames()) {
        if (can::is<can::Status>(frame)) {
          ASSERT_EQ(can::receive(frame, status), can::Verdict::accepted);
        }
      }
    }
  }
};

TEST(KickEnd, StandsAfterFortyDecisionsHoweverLongItStaysArmed) {
  Watch watch;
  watch.arm();
  watch.run(kick_ms - 1);
  EXPECT_GT(watch.moved, 0U);
  EXPECT_EQ(watch.status.kick_over, 0);
  watch.run(12);
  EXPECT_EQ(watch.status.kick_over, 1);
  const std::uint32_t moved = watch.moved;
  watch.run(5'000);
  EXPECT_EQ(watch.moved, moved);
  EXPECT_EQ(watch.rig.state(), core::State::active) << "standing is no fault";
  EXPECT_EQ(watch.status.kick_over, 1);
}

TEST(KickEnd, TheNextArmingBeginsAnother) {
  Watch watch;
  watch.arm();
  watch.run(kick_ms + 100);
  ASSERT_EQ(watch.status.kick_over, 1);
  watch.rig.mode(can::Mode::disarm);
  watch.run(12);
  EXPECT_EQ(watch.status.kick_over, 0);
  watch.arm();
  watch.run(kick_ms / 2);
  EXPECT_GT(watch.moved, 0U);
  EXPECT_EQ(watch.status.kick_over, 0);
}

}  // namespace
}  // namespace striker::loop

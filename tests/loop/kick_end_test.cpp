// SPDX-License-Identifier: Apache-2.0
// A kick ends by itself: 40 decisions of 50 ms, as the task has it, and then the robot is told to stand.
#include <gtest/gtest.h>

#include <array>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

constexpr std::uint32_t kick_ms = 40 * 50;

// The last Status, ticks that moved, and the tick of the first decision.
struct Watch {
  NodeRig rig;
  can::Status status;
  std::uint32_t moved = 0;
  std::uint32_t first_tick = 0;

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
    first_tick = rig.now() - 1;
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

// On a field of 2 cm each way no decision may move the robot, which takes 3 cm for one and 1 to stop: the kick
// is over with the first that would, and the next arming begins another.
TEST(KickEnd, ComesBeforeTheBorderThatTheDescriptionSets) {
  core::RobotDescription fenced = core::forward;
  fenced.field_half_length_mm = 20;
  fenced.field_half_width_mm = 20;
  Watch watch;
  watch.rig.node = GatedNode<BuiltInNode>(core::profile_of(fenced));
  for (int armed = 0; armed < 2; ++armed) {
    watch.arm();
    watch.run(kick_ms);
    EXPECT_EQ(watch.moved, 0U);
    EXPECT_EQ(watch.status.kick_over, 1);
    EXPECT_EQ(watch.rig.state(), core::State::active);
    watch.rig.mode(can::Mode::disarm);
    watch.rig.tick();
  }
}

// Pictures that come up to 5 ms after the decision they were due for: it is made again, is one of the forty, and is told
// once, no sooner after another than the message table says.
TEST(KickEnd, APictureThatComesALittleLateTakesNoDecisionFromTheKick) {
  Watch watch;
  watch.arm();
  std::uint32_t told = 1;
  std::uint32_t told_tick = watch.first_tick;
  std::uint32_t extrapolated = 0;
  for (std::uint32_t i = 0; i < kick_ms - 100; ++i) {
    constexpr std::array<std::uint32_t, 7> late_ticks = {0, 1, 5, 3, 0, 4, 2};
    watch.rig.picture_late_ticks = late_ticks.at(watch.rig.now() / 50 % late_ticks.size());
    watch.rig.decision.reset();
    watch.run(1);
    if (watch.rig.decision) {
      const std::uint32_t tick = watch.rig.now() - 1;
      EXPECT_EQ(watch.rig.decision->number, told++);
      EXPECT_EQ(watch.rig.decision->number, (tick - watch.first_tick + 25) / 50);
      EXPECT_GE(tick - told_tick, can::layout<can::Decision>.info.traffic.distance_ms);
      told_tick = tick;
      extrapolated += watch.rig.decision->extrapolated != 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(extrapolated, 0U) << "each had its picture in the end";
  EXPECT_EQ(watch.status.kick_over, 0);
  watch.run(120);
  EXPECT_EQ(watch.status.kick_over, 1);
}

// As if the better picture had come in time.
TEST(KickEnd, ADecisionThatIsMadeAgainLeavesNoTraceOfTheFirst) {
  const auto ball_at = [](std::int32_t x_um) {
    core::RelativeState seen;
    seen.ball_um = {x_um, x_um / 2};
    return seen;
  };
  using core::DecisionDue;
  BuiltInPilot in_time;
  BuiltInPilot late;
  for (std::int32_t i = 0; i < 5; ++i) {
    const core::RelativeState seen = ball_at(900'000 - 100'000 * i);
    const core::Decision expected = in_time.decide(seen, DecisionDue::on_picture);
    EXPECT_TRUE(late.decide(ball_at(600'000 + i), DecisionDue::extrapolated).extrapolated);
    const core::Decision made = late.decide(seen, DecisionDue::again);
    EXPECT_EQ(made.number, expected.number);
    EXPECT_EQ(made.action, expected.action);
    EXPECT_FALSE(made.extrapolated);
    EXPECT_EQ(late.inputs(), in_time.inputs()) << i;
  }
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

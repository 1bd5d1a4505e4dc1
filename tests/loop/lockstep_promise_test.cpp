// SPDX-License-Identifier: Apache-2.0
// Lockstep attacked: Syncs that stand still, go back, leap, restart or stop, and what comes between them. Time that
// does not pass moves nothing, and a stop is lost in no queue and by no restart.
#include <gtest/gtest.h>

#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "tests/loop/bench/memory_bus.hpp"

namespace striker::loop {
namespace {

using core::Fault;
using core::State;

class LockstepPromise : public testing::Test {
 protected:
  using Bus = MemoryBus<std::int64_t>;

  // Everything that waits, and the Sync; all turns that come of it.
  void give(std::uint32_t tick) {
    bus_.waiting.push_back(world_.sync(tick));
    bus_.sent.clear();
    while (loop_.turn()) {
    }
    world_.hear(bus_.sent);
  }
  void turn(std::uint32_t tick) {
    const auto frames = world_.frames_of(tick);
    bus_.waiting.insert(bus_.waiting.end(), frames.begin(), frames.end());
    give(tick);
  }
  void drive() {
    for (std::uint32_t tick = 0; tick < driven; ++tick) {
      turn(tick);
    }
    ASSERT_TRUE(has_torque(bus_.sent));
  }
  [[nodiscard]] State state() const { return loop_.node().controller().state(); }
  [[nodiscard]] Fault fault() const { return loop_.node().controller().fault(); }
  [[nodiscard]] bool stopped() const {
    return (loop_.node().controller().faults() & core::set_of(Fault::emergency_stop)) != 0;
  }
  static can::Frame stop() {
    can::SendCounter counter;
    return can::send(can::EmergencyStop{}, counter);
  }

  static constexpr std::uint32_t driven = 300;
  World world_;
  Bus bus_;
  SyncTicks ticks_;
  TickLoop<BuiltInNode, Bus&, SyncTicks&> loop_{built_in_robot, bus_, ticks_};
};

TEST_F(LockstepPromise, TimeThatStandsStillMovesNothing) {
  drive();
  std::size_t moved = 0;
  for (int i = 0; i < 60'000; ++i) {
    give(driven - 1);
    moved += has_torque(bus_.sent) ? 1 : 0;
  }
  EXPECT_EQ(moved, 0U);
  EXPECT_EQ(fault(), Fault::sync_invalid);
}

TEST_F(LockstepPromise, ASyncThatComesTwiceDoesNoHarm) {
  drive();
  for (std::uint32_t tick = driven; tick < driven + 500; ++tick) {
    turn(tick);
    if (tick % 50 == 7) {
      give(tick);
      EXPECT_TRUE(bus_.sent.empty());
    }
  }
  EXPECT_EQ(state(), State::active);
}

TEST_F(LockstepPromise, TimeThatGoesBackIsAFault) {
  drive();
  for (int i = 0; i < 3; ++i) {
    give(driven - 20);
    EXPECT_FALSE(has_torque(bus_.sent));
  }
  EXPECT_EQ(fault(), Fault::sync_invalid);
}

TEST_F(LockstepPromise, ALeapIsAFault) {
  drive();
  turn(driven + 2'000);
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_EQ(fault(), Fault::sync_invalid);
}

TEST_F(LockstepPromise, TwoSimulatorsAreAFault) {
  drive();
  World other;
  std::uint32_t tick = driven;
  bool moved = false;
  for (std::uint32_t theirs = 0; theirs < 100; ++theirs, ++tick) {
    bus_.waiting.push_back(other.sync(theirs));
    turn(tick);
    moved = has_torque(bus_.sent);
  }
  EXPECT_FALSE(moved);
  EXPECT_EQ(state(), State::fault);
  EXPECT_EQ(fault(), Fault::sync_invalid);
}

class BurstPromise : public LockstepPromise, public testing::WithParamInterface<std::size_t> {};

// A button that is pressed on a bus which somebody floods.
TEST_P(BurstPromise, AStopBehindAnyBurstActsInItsTick) {
  drive();
  const can::Frame babble{.id = 0x123, .length = 0};
  bus_.waiting.assign(GetParam(), babble);
  bus_.waiting.push_back(stop());
  turn(driven);
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_TRUE(stopped());
}

INSTANTIATE_TEST_SUITE_P(Frames, BurstPromise, testing::Values(0U, 31U, 32U, 33U, 300U, 5'000U));

TEST_F(LockstepPromise, FramesBeyondTheRoomAreCountedAndAFault) {
  drive();
  bus_.waiting.assign(40, {.id = 0x123, .length = 0});
  turn(driven);
  EXPECT_EQ(fault(), Fault::frames_lost);
}

TEST_F(LockstepPromise, ARestartOfTimeKeepsAStop) {
  drive();
  bus_.waiting.push_back(stop());
  turn(driven);
  ASSERT_TRUE(stopped());
  for (int restart = 0; restart < 3; ++restart) {
    world_ = {};
    for (std::uint32_t tick = 0; tick < 400; ++tick) {
      turn(tick);
      ASSERT_EQ(state(), State::fault) << tick;
      ASSERT_TRUE(stopped());
    }
  }
}

TEST_F(LockstepPromise, ARestartOfTimeKeepsAStopThatStillWaits) {
  drive();
  bus_.waiting = {stop()};
  EXPECT_FALSE(loop_.turn());
  give(0);
  EXPECT_TRUE(stopped());
}

// Frames on the stop's identifier that are none, before and behind it, also where there is no room for all.
TEST(LockstepStop, AWrongOneTakesNoRightOnesPlace) {
  can::SendCounter counter;
  const can::Frame right = can::send(can::EmergencyStop{}, counter);
  can::Frame wrong = right;
  wrong.data[0] ^= 1U;
  for (const std::size_t before : {0U, 1U, 40U}) {
    for (const std::size_t behind : {0U, 1U, 40U}) {
      for (const std::uint32_t tick : {0U, 1U}) {  // a restart, or the next
        World world;
        MemoryBus<std::int64_t> bus;
        SyncTicks ticks;
        TickLoop<BuiltInNode, MemoryBus<std::int64_t>&, SyncTicks&> loop(built_in_robot, bus, ticks);
        bus.waiting = {world.sync(0)};
        bus.waiting.insert(bus.waiting.end(), before, wrong);
        bus.waiting.push_back(right);
        bus.waiting.insert(bus.waiting.end(), behind, wrong);
        bus.waiting.push_back(world.sync(tick));
        while (loop.turn()) {
        }
        EXPECT_NE(loop.node().controller().faults() & core::set_of(Fault::emergency_stop), 0U)
            << before << " " << behind << " " << tick;
      }
    }
  }
}

TEST_F(LockstepPromise, ALostSyncIsToldAgainAndAgain) {
  drive();
  int reports = 0;
  for (int i = 0; i < 10; ++i) {
    bus_.sent.clear();
    ticks_.overdue();
    EXPECT_TRUE(loop_.turn());
    EXPECT_FALSE(has_torque(bus_.sent));
    for (const can::Frame& frame : bus_.sent) {
      reports += can::is<can::FaultReport>(frame) ? 1 : 0;
    }
  }
  EXPECT_EQ(fault(), Fault::sync_lost);
  EXPECT_EQ(reports, 10);
}

}  // namespace
}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// The loop in lockstep: a Sync is a tick, its answer ends with EndOfTick, and a Sync that does not come is a fault.
#include <gtest/gtest.h>

#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "tests/loop/bench/memory_bus.hpp"

namespace striker::loop {
namespace {

class Lockstep : public testing::Test {
 protected:
  using Bus = MemoryBus<std::int64_t>;

  bool turn(std::uint32_t tick) {
    bus_.waiting = world_.frames_of(tick);
    bus_.waiting.push_back(world_.sync(tick));
    bus_.sent.clear();
    const bool turned = loop_.turn();
    world_.hear(bus_.sent);
    return turned;
  }
  [[nodiscard]] std::int32_t ended_tick() const {
    can::EndOfTick end;
    const bool ended = !bus_.sent.empty() && can::is<can::EndOfTick>(bus_.sent.back()) &&
                       can::unpack(bus_.sent.back(), end) == can::Verdict::accepted;
    return ended ? end.tick : -1;
  }

  World world_;
  Bus bus_;
  SyncTicks ticks_;
  TickLoop<BuiltInNode, Bus&, SyncTicks&> loop_{built_in_robot, bus_, ticks_};
};

TEST_F(Lockstep, EverySyncIsAnsweredAndTheAnswerEndsWithItsTick) {
  for (std::uint32_t tick = 0; tick < 300; ++tick) {
    ASSERT_TRUE(turn(tick));
    ASSERT_EQ(ended_tick(), static_cast<std::int32_t>(tick));
  }
  EXPECT_EQ(loop_.node().controller().state(), core::State::active);
}

TEST_F(Lockstep, WithoutASyncThereIsNoTick) {
  EXPECT_FALSE(loop_.turn());
  turn(0);
  bus_.waiting = world_.frames_of(1);
  EXPECT_FALSE(loop_.turn());
}

TEST_F(Lockstep, AnOverdueSyncIsOneFaultWithoutAnEndOfTick) {
  ticks_.overdue();
  EXPECT_FALSE(loop_.turn()) << "before the first Sync nothing is overdue";
  for (std::uint32_t tick = 0; tick < 260; ++tick) {
    turn(tick);
  }
  bus_.sent.clear();
  ticks_.overdue();
  EXPECT_TRUE(loop_.turn());
  EXPECT_EQ(loop_.node().controller().fault(), core::Fault::sync_lost);
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_EQ(ended_tick(), -1);
}

TEST_F(Lockstep, ABusThatGoesOffBetweenTwoSyncsIsAFaultAtOnce) {
  for (std::uint32_t tick = 0; tick < 260; ++tick) {
    turn(tick);
  }
  bus_.sent.clear();
  bus_.now = can::BusHealth::bus_off;
  EXPECT_TRUE(loop_.turn());
  EXPECT_EQ(loop_.node().controller().fault(), core::Fault::bus_off);
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_EQ(ended_tick(), -1);
}

// What waits for the next Sync is not the port's: a stop that was pressed meanwhile is not lost.
TEST_F(Lockstep, AStopThatCameBeforeAnOverdueSyncIsTakenWithTheNextOne) {
  for (std::uint32_t tick = 0; tick < 260; ++tick) {
    turn(tick);
  }
  can::SendCounter counter;
  bus_.waiting = {can::send(can::EmergencyStop{}, counter)};
  EXPECT_FALSE(loop_.turn());
  ticks_.overdue();
  EXPECT_TRUE(loop_.turn());
  for (std::uint32_t tick = 260; tick < 300; ++tick) {
    bus_.waiting = world_.frames_of(tick);
    bus_.waiting.push_back(world_.mode(can::Mode::clear));
    bus_.waiting.push_back(world_.sync(tick));
    bus_.sent.clear();
    loop_.turn();
    world_.hear(bus_.sent);
    ASSERT_EQ(loop_.node().controller().state(), core::State::fault) << "the stop still holds";
  }
}

TEST_F(Lockstep, SyncZeroBeginsAnewWithTheSameAnswers) {
  std::vector<std::vector<can::Frame>> first;
  for (std::uint32_t tick = 0; tick < 260; ++tick) {
    turn(tick);
    first.push_back(bus_.sent);
  }
  world_ = {};
  for (std::uint32_t tick = 0; tick < 260; ++tick) {
    turn(tick);
    ASSERT_EQ(bus_.sent, first[tick]) << tick;
  }
}

}  // namespace
}  // namespace striker::loop

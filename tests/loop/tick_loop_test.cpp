// SPDX-License-Identifier: Apache-2.0
// The one loop, as a board runs it: on a logical clock of microseconds and a bus in memory that goes off, takes
// no frame, or is flooded; and in lockstep.
#include "firmware/loop/tick_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/clock_ticks.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "tests/loop/bench/memory_bus.hpp"

namespace striker::loop {
namespace {

// Wakes on time, but for the stalls that it was given, in whole ticks.
class LogicalClock {
 public:
  using Time = std::int32_t;                             // us
  std::map<std::uint32_t, std::uint32_t> missed_before;  // by the tick that was waited for

  template <class Idle>
  Wake<Time> wait(Idle idle) {
    idle();
    const auto stall = missed_before.find(tick_ + 1);
    const std::uint32_t missed = stall == missed_before.end() ? 0 : stall->second;
    tick_ += 1 + missed;
    return {.tick = tick_, .missed = missed, .lateness = static_cast<Time>(1000 * missed)};
  }
  Time now() { return static_cast<Time>(1000 * tick_); }
  static std::int32_t to_us(Time us) { return us; }

 private:
  std::uint32_t tick_ = 0;
};

class BoardLoop : public testing::Test {
 protected:
  using Bus = MemoryBus<std::int32_t>;
  using Ticks = ClockTicks<LogicalClock>;

  void turn() {
    const auto frames = world_.frames_of(tick_ + 1);
    bus_.waiting.insert(bus_.waiting.end(), frames.begin(), frames.end());
    bus_.sent.clear();
    loop_.turn();
    world_.hear(bus_.sent);
    tick_ = ticks_.last().wake.tick;
  }
  void turn_until(std::uint32_t tick) {
    while (tick_ < tick) {
      turn();
    }
  }
  [[nodiscard]] core::State state() const { return loop_.node().controller().state(); }
  [[nodiscard]] core::Fault fault() const { return loop_.node().controller().fault(); }

  LogicalClock clock_;
  World world_;
  Bus bus_;
  Ticks ticks_{clock_, {.frames_per_tick = 24, .overrun_limit = 50}};
  TickLoop<BuiltInNode, Bus&, Ticks&> loop_{built_in_robot, bus_, ticks_};
  std::uint32_t tick_ = 0;
};

TEST_F(BoardLoop, ArmsAndDrives) {
  turn_until(260);
  EXPECT_EQ(state(), core::State::active);
  EXPECT_TRUE(has_torque(bus_.sent));
}

TEST_F(BoardLoop, AStallBeyondTheLimitTakesTheTorqueInItsOwnTick) {
  turn_until(260);
  clock_.missed_before[261] = 10;  // the wheel states stay fresh
  turn();
  EXPECT_EQ(state(), core::State::active);
  for (std::uint32_t tick = 281; fault() == core::Fault::none && tick < 500; tick += 20) {
    turn_until(tick - 1);
    clock_.missed_before[tick] = 9;
    turn();
    if (fault() != core::Fault::none) {
      EXPECT_FALSE(has_torque(bus_.sent));
    }
  }
  EXPECT_EQ(fault(), core::Fault::overrun);
}

TEST_F(BoardLoop, ABusThatIsOffIsAFaultAsLongAsItIs) {
  turn_until(260);
  bus_.now = can::BusHealth::error_passive;
  turn();
  EXPECT_EQ(state(), core::State::active) << "error passive still sends and receives";
  bus_.now = can::BusHealth::bus_off;
  turn();
  EXPECT_EQ(fault(), core::Fault::bus_off);
  EXPECT_FALSE(has_torque(bus_.sent));
  bus_.waiting.push_back(world_.mode(can::Mode::clear));
  turn();
  turn();
  EXPECT_EQ(state(), core::State::fault) << "the bus is still off";
  bus_.now = can::BusHealth::active;
  bus_.waiting.push_back(world_.mode(can::Mode::clear));
  turn();
  turn();
  EXPECT_EQ(state(), core::State::standby);
}

TEST_F(BoardLoop, WhatTheBusDoesNotTakeIsCountedAndStopsNothing) {
  turn_until(260);
  const std::uint64_t before = loop_.dropped_frames();
  bus_.room = 0;
  turn_until(270);
  EXPECT_GE(loop_.dropped_frames() - before, 10U);
  EXPECT_TRUE(bus_.sent.empty());
  bus_.room = 100;
  turn();
  EXPECT_EQ(state(), core::State::active);
  EXPECT_TRUE(has_torque(bus_.sent));
}

// More wait for the next tick: none is lost, and no tick takes more than its share.
TEST_F(BoardLoop, AFloodTakesItsShareOfATickAndNoMore) {
  turn_until(260);
  for (int i = 0; i < 100; ++i) {
    bus_.waiting.push_back({.id = 0x123, .length = 0});
  }
  turn();
  EXPECT_EQ(ticks_.last().received, 24U);
  EXPECT_TRUE(ticks_.last().full);
  turn_until(266);
  EXPECT_TRUE(bus_.waiting.empty());
  EXPECT_EQ(state(), core::State::active);
}

// A node that has gone mad: what it may not send does not go out.
class MadNode {
 public:
  using Drives = can::StrikerDrives;
  explicit MadNode(const core::RobotProfile&, std::uint32_t) {}
  void seed_challenges(std::uint32_t) {}
  void step(const Tick&, const GateReport&, can::FrameList& frames) {
    frames.clear();
    frames.add({.id = 0x040, .length = 2, .data = {}});  // an operator's command
    frames.add({.id = 0x050, .length = 8, .data = {}});
    frames.add({.id = 0x050, .length = 7, .data = {}});
  }
};

TEST(TickLoop, OnlyWhatIsOnTheWhitelistGoesOut) {
  LogicalClock clock;
  MemoryBus<std::int32_t> bus;
  ClockTicks<LogicalClock> ticks(clock, {.frames_per_tick = 24, .overrun_limit = 50});
  TickLoop<MadNode, MemoryBus<std::int32_t>&, ClockTicks<LogicalClock>&> loop(built_in_robot, bus, ticks);
  loop.turn();
  ASSERT_EQ(bus.sent.size(), 1U);
  EXPECT_EQ(bus.sent.front().id, 0x050);
  EXPECT_EQ(bus.sent.front().length, 8);
  EXPECT_EQ(loop.gate().refused(), 2U);
}

TEST_F(BoardLoop, TheEndTakesTheTorque) {
  turn_until(260);
  bus_.sent.clear();
  loop_.stop();
  EXPECT_FALSE(bus_.sent.empty());
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_EQ(state(), core::State::standby);
}

std::vector<can::Frame> challenges(const std::vector<can::Frame>& sent) {
  std::vector<can::Frame> found;
  std::copy_if(sent.begin(), sent.end(), std::back_inserter(found), can::is<can::Challenge>);
  return found;
}

// The two sources of ticks differ in when, not in what: the same frames at the same ticks, the same answers.
TEST(TickLoop, LockstepAndTheClockGiveTheSameAnswers) {
  LogicalClock clock;
  MemoryBus<std::int32_t> clocked_bus;
  ClockTicks<LogicalClock> clock_ticks(clock, {.frames_per_tick = 24, .overrun_limit = 50});
  TickLoop<BuiltInNode, MemoryBus<std::int32_t>&, ClockTicks<LogicalClock>&> clocked(
      built_in_robot, clocked_bus, clock_ticks);
  MemoryBus<std::int64_t> sync_bus;
  SyncTicks sync_ticks;
  TickLoop<BuiltInNode, MemoryBus<std::int64_t>&, SyncTicks&> synchronous(built_in_robot, sync_bus,
                                                                          sync_ticks);
  World world;
  sync_bus.waiting = {world.sync(0)};
  synchronous.turn();
  for (std::uint32_t tick = 1; tick < 1000; ++tick) {
    const auto frames = world.frames_of(tick);
    clocked_bus.waiting = sync_bus.waiting = frames;
    sync_bus.waiting.push_back(world.sync(tick));
    clocked_bus.sent.clear();
    sync_bus.sent.clear();
    clocked.turn();
    synchronous.turn();
    world.hear(clocked_bus.sent);
    ASSERT_EQ(challenges(clocked_bus.sent), challenges(sync_bus.sent));
    if (tick < 50) {
      continue;  // lockstep had tick 0 more, and is a golden vector ahead in the self-test
    }
    ASSERT_EQ(clocked.node().controller().state(), synchronous.node().controller().state()) << tick;
    ASSERT_EQ(has_torque(clocked_bus.sent), has_torque(sync_bus.sent)) << tick;
    const auto command = [](const std::vector<can::Frame>& sent) {
      can::WheelCommand found;
      for (const can::Frame& frame : sent) {
        if (can::is<can::WheelCommand>(frame)) {
          static_cast<void>(can::unpack(frame, found));
        }
      }
      return can::pack(found);
    };
    ASSERT_EQ(command(clocked_bus.sent), command(sync_bus.sent)) << tick;
  }
}

}  // namespace
}  // namespace striker::loop

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

template <class Time>
class MemoryBus {
 public:
  std::vector<can::Frame> waiting;
  std::vector<can::Frame> sent;  // since it was last cleared
  can::BusHealth now = can::BusHealth::active;
  std::size_t room = 100;  // frames that it takes in a tick

  void poll() {}
  Received<Time> receive(std::size_t most) {
    const std::size_t count = std::min(most, waiting.size());
    batch_.assign(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
    return {.frames = batch_, .oldest = 0};
  }
  std::size_t try_send(std::span<const can::Frame> frames) {
    const std::size_t taken = std::min(room, frames.size());
    sent.insert(sent.end(), frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(taken));
    return taken;
  }
  [[nodiscard]] can::BusHealth health() const { return now; }

 private:
  std::vector<can::Frame> batch_;
};

// Everything that sends to a controller.
class World {
 public:
  std::vector<can::Frame> frames_of(std::uint32_t tick) {
    std::vector<can::Frame> frames;
    if (tick % 50 == 0) {
      const auto number = static_cast<std::int32_t>(tick / 50 % 16);
      frames.push_back(can::send(can::VisionPose{.frame = number}, pose_));
      frames.push_back(can::send(can::VisionBall{.frame = number, .x_quarter_mm = 6000}, ball_));
    }
    frames.push_back(can::send(can::WheelState{}, wheels_));
    if (tick == 160) {
      frames.push_back(mode(can::Mode::arm));
    }
    return frames;
  }
  can::Frame mode(can::Mode mode) {
    return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_);
  }
  can::Frame sync(std::uint32_t tick) {
    return can::send(can::Sync{.tick = static_cast<std::int32_t>(tick)}, sync_);
  }

 private:
  can::SendCounter pose_, ball_, wheels_, mode_, sync_;
};

bool has_torque(const std::vector<can::Frame>& frames) {
  for (const can::Frame& frame : frames) {
    can::WheelCommand command;
    if (can::is<can::WheelCommand>(frame) && can::unpack(frame, command) == can::Verdict::accepted &&
        (command.left_torque_mNm != 0 || command.right_torque_mNm != 0)) {
      return true;
    }
  }
  return false;
}

class BoardLoop : public testing::Test {
 protected:
  using Bus = MemoryBus<std::int32_t>;
  using Ticks = ClockTicks<LogicalClock>;

  void turn() {
    const auto frames = world_.frames_of(tick_ + 1);
    bus_.waiting.insert(bus_.waiting.end(), frames.begin(), frames.end());
    bus_.sent.clear();
    loop_.turn();
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
  EXPECT_EQ(state(), core::State::fault) << "the bus is still off";
  bus_.now = can::BusHealth::active;
  bus_.waiting.push_back(world_.mode(can::Mode::clear));
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
  explicit MadNode(const core::RobotProfile&) {}
  void step(const Tick&, can::FrameList& frames) {
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
  EXPECT_EQ(loop.refused_frames(), 2U);
}

TEST_F(BoardLoop, TheEndTakesTheTorque) {
  turn_until(260);
  bus_.sent.clear();
  loop_.stop();
  EXPECT_FALSE(bus_.sent.empty());
  EXPECT_FALSE(has_torque(bus_.sent));
  EXPECT_EQ(state(), core::State::standby);
}

class Lockstep : public testing::Test {
 protected:
  using Bus = MemoryBus<std::int64_t>;

  bool turn(std::uint32_t tick) {
    bus_.waiting = world_.frames_of(tick);
    bus_.waiting.push_back(world_.sync(tick));
    bus_.sent.clear();
    return loop_.turn();
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
  ticks_.overdue();
  EXPECT_FALSE(loop_.turn());
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

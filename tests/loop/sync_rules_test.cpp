// SPDX-License-Identifier: Apache-2.0
// Lockstep's ticks by themselves, at each of their limits.
#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "firmware/loop/bus.hpp"
#include "firmware/loop/sync_ticks.hpp"

namespace striker::loop {
namespace {

constexpr core::Faults sync_invalid = core::set_of(core::Fault::sync_invalid);
constexpr core::Faults sync_lost = core::set_of(core::Fault::sync_lost);

class QueueBus {
 public:
  std::deque<can::Frame> waiting;
  can::BusHealth now = can::BusHealth::active;

  Received<std::int64_t> receive(std::size_t) {
    batch_.clear();
    if (!waiting.empty()) {
      batch_.push_back(waiting.front());
      waiting.pop_front();
    }
    return {.frames = batch_};
  }
  [[nodiscard]] can::BusHealth health() const { return now; }

 private:
  std::vector<can::Frame> batch_;
};

class SyncRules : public testing::Test {
 protected:
  QueueBus bus;
  SyncTicks ticks;
  can::SendCounter counter;

  void put(const can::Frame& frame) { bus.waiting.push_back(frame); }
  void put_sync(std::uint32_t tick) {
    put(can::send(can::Sync{.tick = static_cast<std::int32_t>(tick)}, counter));
  }
  void put_wheels(int count) {
    for (int i = 0; i < count; ++i) {
      put(can::send(can::WheelState{.left_mm_s = i}, counter));
    }
  }
  // The next tick, and its end.
  std::optional<Tick> turn() {
    auto tick = ticks.next(bus);
    if (tick) {
      frames.assign(tick->frames.begin(), tick->frames.end());
      sent.clear();
      ticks.end(sent);
      ticks.done();
    }
    return tick;
  }
  std::optional<Tick> sync(std::uint32_t tick) {
    put_sync(tick);
    return turn();
  }

  std::vector<can::Frame> frames;  // of the last tick
  can::FrameList sent;
};

TEST_F(SyncRules, ASyncBeginsATickAndItsEndNamesIt) {
  EXPECT_FALSE(ticks.running());
  EXPECT_FALSE(turn());
  EXPECT_FALSE(ticks.answered_sync());
  put_wheels(2);
  const auto tick = sync(7);
  ASSERT_TRUE(tick);
  EXPECT_TRUE(ticks.running());
  EXPECT_TRUE(ticks.answered_sync());
  EXPECT_EQ(tick->number, 7U);
  EXPECT_EQ(tick->port_faults, 0U);
  EXPECT_FALSE(tick->restart);
  EXPECT_EQ(frames.size(), 2U);
  can::EndOfTick end;
  ASSERT_EQ(sent.frames().size(), 1U);
  ASSERT_EQ(can::receive(sent.frames().front(), end), can::Verdict::accepted);
  EXPECT_EQ(end.tick, 7);
  EXPECT_TRUE(sync(8));
  EXPECT_TRUE(frames.empty());
}

TEST_F(SyncRules, ASyncZeroRestartsAndForgetsAllButAStop) {
  sync(5);
  put_wheels(3);
  auto tick = sync(0);
  ASSERT_TRUE(tick);
  EXPECT_TRUE(tick->restart);
  EXPECT_EQ(tick->number, 0U);
  EXPECT_TRUE(frames.empty());
  put_wheels(1);
  put(can::send(can::EmergencyStop{}, counter));
  put_wheels(1);
  sync(0);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(can::is<can::EmergencyStop>(frames.front()));
  EXPECT_TRUE(sync(1));
}

TEST_F(SyncRules, TimeMayLeap1000TicksAndNoMore) {
  sync(1);
  auto tick = sync(1001);
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->port_faults, 0U);
  tick = sync(2002);
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->port_faults, sync_invalid);
  EXPECT_EQ(tick->number, 2002U);
}

TEST_F(SyncRules, TheFirstSyncMayBeAny) {
  const auto tick = sync(0x7FFFFFFF);
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->number, 0x7FFFFFFFU);
  EXPECT_EQ(tick->port_faults, 0U);
}

TEST_F(SyncRules, TimeGoesOnOverTheWrapOf31Bits) {
  sync(0x7FFFFFFE);
  EXPECT_EQ(sync(0x7FFFFFFF)->number, 0x7FFFFFFFU);
  const auto tick = sync(3);  // 0 is a restart
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->number, 0x80000003U);
  can::EndOfTick end;
  ASSERT_EQ(can::receive(sent.frames().front(), end), can::Verdict::accepted);
  EXPECT_EQ(end.tick, 3);
}

TEST_F(SyncRules, HalfTheWrapAheadIsALeapAndBeyondItIsBack) {
  sync(1);
  EXPECT_FALSE(sync(0x40000001)) << "2^30 ahead";
  ticks = {};
  sync(1);
  const auto tick = sync(0x40000000);
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->port_faults, sync_invalid);
}

TEST_F(SyncRules, TimeThatStandsStillOrGoesBackIsIgnoredTwiceAndThenAFault) {
  sync(10);
  put_wheels(1);
  EXPECT_FALSE(sync(10));
  EXPECT_FALSE(sync(9));
  const auto tick = sync(10);
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->number, 10U);
  EXPECT_EQ(tick->port_faults, sync_invalid);
  EXPECT_FALSE(ticks.answered_sync());
  EXPECT_TRUE(sent.frames().empty()) << "no end of tick";
  EXPECT_FALSE(sync(10)) << "it counts anew";
  EXPECT_FALSE(sync(10));
  EXPECT_TRUE(sync(10));
  EXPECT_TRUE(sync(11));
  EXPECT_EQ(frames.size(), 1U) << "what was kept is still there";
}

// Two errors weigh 8 of 12; each good Sync takes 1 back, and two more errors add 8.
TEST_F(SyncRules, AGoodSyncForgivesAQuarterOfAnError) {
  for (const int good : {4, 5}) {
    ticks = {};
    std::uint32_t now = 10;
    sync(now);
    EXPECT_FALSE(sync(now));
    EXPECT_FALSE(sync(now));
    for (int i = 0; i < good; ++i) {
      ASSERT_TRUE(sync(++now));
    }
    EXPECT_FALSE(sync(now));
    EXPECT_EQ(sync(now).has_value(), good == 4);
  }
}

TEST_F(SyncRules, AWrongSyncIsIgnoredAndCounts) {
  sync(1);
  for (int i = 0; i < 3; ++i) {
    can::Frame wrong = can::send(can::Sync{.tick = 2}, counter);
    wrong.data[0] ^= 1U;
    put(wrong);
    EXPECT_EQ(turn().has_value(), i == 2);
  }
}

// Three errors and a good Sync between them weigh 11 of 12, after a restart and after a fault was told: nothing is left over.
TEST_F(SyncRules, EveryAccountOfErrorsBeginsEmpty) {
  const auto is_told_after_a_wrong_one = [this] {
    can::Frame wrong = can::send(can::Sync{.tick = 1}, counter);
    wrong.data[0] ^= 1U;
    put(wrong);
    return turn().has_value();
  };
  ASSERT_TRUE(sync(0));
  for (std::uint32_t round = 1; round <= 2; ++round) {
    EXPECT_FALSE(is_told_after_a_wrong_one());
    ASSERT_TRUE(sync(round));
    EXPECT_FALSE(is_told_after_a_wrong_one());
    EXPECT_FALSE(is_told_after_a_wrong_one());
    EXPECT_TRUE(is_told_after_a_wrong_one());
  }
}

TEST_F(SyncRules, ThirtyTwoFramesAreKeptAndTheOthersCounted) {
  put_wheels(32);
  auto tick = sync(1);
  EXPECT_EQ(tick->lost_frames, 0U);
  EXPECT_EQ(frames.size(), 32U);
  put_wheels(35);
  tick = sync(2);
  EXPECT_EQ(tick->lost_frames, 3U);
  EXPECT_EQ(frames.size(), 32U);
  can::WheelState last;
  ASSERT_EQ(can::receive(frames.back(), last), can::Verdict::accepted);
  EXPECT_EQ(last.left_mm_s, 31) << "the oldest are kept";
  tick = sync(3);
  EXPECT_EQ(tick->lost_frames, 0U);
}

TEST_F(SyncRules, AStopBehindABurstIsKept) {
  put_wheels(40);
  put(can::send(can::EmergencyStop{}, counter));
  const auto tick = sync(1);
  EXPECT_EQ(tick->lost_frames, 9U);
  EXPECT_TRUE(can::is<can::EmergencyStop>(frames.back()));
}

TEST_F(SyncRules, AnOverdueSyncIsToldOnceAndAgain) {
  ticks.overdue();
  EXPECT_FALSE(turn()) << "no Sync has come at all";
  sync(1);
  put_wheels(1);
  ticks.overdue();
  auto tick = turn();
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->port_faults, sync_lost);
  EXPECT_EQ(tick->number, 1U);
  EXPECT_FALSE(tick->repeat_fault);
  EXPECT_FALSE(ticks.answered_sync());
  EXPECT_TRUE(sent.frames().empty());
  EXPECT_FALSE(turn()) << "once";
  ticks.overdue();
  tick = turn();
  ASSERT_TRUE(tick);
  EXPECT_TRUE(tick->repeat_fault);
  EXPECT_TRUE(sync(2));
  EXPECT_EQ(frames.size(), 1U) << "what was kept is still there";
  ticks.overdue();
  EXPECT_FALSE(turn()->repeat_fault) << "another loss";
}

TEST_F(SyncRules, ASyncThatCameMeanwhileIsNotOverdue) {
  sync(1);
  ticks.overdue();
  EXPECT_EQ(sync(2)->port_faults, 0U);
  EXPECT_FALSE(turn());
}

TEST_F(SyncRules, ABusThatGoesOffIsATickOfThePortsOwnOnce) {
  sync(1);
  bus.now = can::BusHealth::bus_off;
  auto tick = turn();
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->port_faults, core::set_of(core::Fault::bus_off));
  EXPECT_FALSE(tick->repeat_fault);
  EXPECT_FALSE(turn());
  ticks.overdue();
  tick = turn();
  EXPECT_EQ(tick->port_faults, sync_lost);
  bus.now = can::BusHealth::active;
  EXPECT_FALSE(turn());
  bus.now = can::BusHealth::bus_off;
  EXPECT_TRUE(turn());
  bus.now = can::BusHealth::error_passive;
  EXPECT_FALSE(turn());
}

}  // namespace
}  // namespace striker::loop

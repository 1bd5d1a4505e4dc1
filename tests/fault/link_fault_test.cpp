// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <set>

#include "sil/fault/link/recode.hpp"
#include "tests/fault/fault_rig.hpp"

namespace striker::sil {
namespace {

constexpr std::uint32_t from = 20;
constexpr std::uint32_t until = 60;

std::int32_t wheel_tick(const std::vector<can::Frame>& frames) {
  for (const can::Frame& frame : frames) {
    if (const auto state = read<can::WheelState>(frame)) {
      return state->left_mm_s;
    }
  }
  return -1;
}

TEST(FrameFault, NoneIsThereBeforeOrAfterItsWindow) {
  for (const FaultKindInfo& info : fault_kinds()) {
    TimedFault fault = fault_of(info.kind, from, until);
    fault.fault.message = identifier<can::WheelState>;
    fault.fault.as = identifier<can::VisionPose>;
    auto made = make_frame_fault(fault, any_random());
    const bool late = info.kind == FaultKind::delay || info.kind == FaultKind::jitter;
    if (!made) {
      continue;
    }
    FaultRig rig(std::move(made));
    SeatFrames seat;
    for (std::uint32_t tick = 0; tick < until + 20; ++tick) {
      const auto frames = seat.at(tick);
      const auto passed = rig.pass(tick, frames);
      if (tick < from || tick >= until + (late ? 6 : 0)) {
        const bool renumbered = info.name.substr(0, 4) == "sync" && tick >= until;
        ASSERT_EQ(passed.size(), frames.size()) << info.name << " " << tick;
        ASSERT_TRUE(renumbered || passed == frames) << info.name << " " << tick;
        ASSERT_EQ(read<can::Sync>(passed.back())->tick, static_cast<std::int32_t>(tick)) << info.name;
      }
    }
  }
}

TEST(FrameFault, LossTakesItsShareOfItsMessageOnly) {
  TimedFault fault = fault_of(FaultKind::loss, 0, 10000);
  fault.fault.message = identifier<can::WheelState>;
  fault.fault.probability = 0.25;
  FaultRig rig(fault);
  SeatFrames seat;
  std::size_t kept = 0;
  for (std::uint32_t tick = 0; tick < 10000; ++tick) {
    const auto passed = rig.pass(tick, seat.at(tick));
    kept += count_of(passed, identifier<can::WheelState>);
    ASSERT_EQ(count_of(passed, identifier<can::Sync>), 1U);
  }
  EXPECT_NEAR(static_cast<double>(kept), 7500.0, 250.0);
}

TEST(FrameFault, LossOfAllLeavesLockstepAloneAndTakesAnswersToo) {
  FaultRig rig(fault_of(FaultKind::loss, 0, 1));
  can::SendCounter status;
  can::SendCounter end;
  rig.end.answers = {can::send(can::Status{}, status), can::send(can::EndOfTick{}, end)};
  SeatFrames seat;
  const auto passed = rig.pass(0, seat.at(0));
  ASSERT_EQ(passed.size(), 1U);
  EXPECT_TRUE(can::is<can::Sync>(passed.front()));
  ASSERT_EQ(rig.answer.size(), 1U);
  EXPECT_TRUE(can::is<can::EndOfTick>(rig.answer.front()));
}

TEST(FrameFault, APictureIsLostAsAWhole) {
  TimedFault fault = fault_of(FaultKind::picture_loss, 0, 1000);
  fault.fault.probability = 0.5;
  FaultRig rig(fault);
  can::SendCounter pose;
  can::SendCounter ball;
  std::set<std::size_t> sizes;
  for (std::uint32_t tick = 0; tick < 1000; ++tick) {
    sizes.insert(
        rig.pass(tick, {can::send(can::VisionPose{}, pose), can::send(can::VisionBall{}, ball)}).size());
  }
  EXPECT_EQ(sizes, (std::set<std::size_t>{0, 2}));
}

TEST(FrameFault, FlipsAsManyBitsAsItSays) {
  for (const std::uint32_t bits : {1U, 2U, 3U}) {
    TimedFault fault = fault_of(FaultKind::flip_bits, 0, 500);
    fault.fault.count = bits;
    FaultRig rig(fault);
    SeatFrames seat;
    for (std::uint32_t tick = 0; tick < 500; ++tick) {
      const auto frames = seat.at(tick);
      const auto passed = rig.pass(tick, frames);
      std::uint32_t flipped = 0;
      for (std::size_t byte = 0; byte < 8; ++byte) {
        flipped += static_cast<std::uint32_t>(
            std::popcount(static_cast<unsigned>(passed[0].data[byte] ^ frames[0].data[byte])));
      }
      ASSERT_EQ(flipped, bits);
      ASSERT_FALSE(read<can::WheelState>(passed[0]));
    }
  }
}

TEST(FrameFault, AWrongLengthIsNeverTheRightOne) {
  FaultRig rig(fault_of(FaultKind::wrong_length, 0, 500));
  SeatFrames seat;
  std::set<int> lengths;
  for (std::uint32_t tick = 0; tick < 500; ++tick) {
    lengths.insert(rig.pass(tick, seat.at(tick)).front().length);
  }
  EXPECT_EQ(lengths.size(), 8U);
  EXPECT_FALSE(lengths.contains(can::layout<can::WheelState>.info.length));
}

TEST(FrameFault, ADelayHoldsEveryFrameForItsTicksAndLosesNone) {
  TimedFault fault = fault_of(FaultKind::delay, from, until);
  fault.fault.message = identifier<can::WheelState>;
  fault.fault.count = 7;
  FaultRig rig(fault);
  SeatFrames seat;
  for (std::uint32_t tick = 0; tick < until + 7; ++tick) {
    const auto passed = rig.pass(tick, seat.at(tick));
    if (tick >= from && tick < from + 7) {
      ASSERT_EQ(count_of(passed, identifier<can::WheelState>), 0U) << tick;
    } else if (tick >= from) {
      ASSERT_EQ(wheel_tick(passed), static_cast<std::int32_t>(tick - 7)) << tick;
    }
    ASSERT_TRUE(can::is<can::Sync>(passed.back()));
  }
}

TEST(FrameFault, JitterLosesNoFrameAndMakesSomeLate) {
  TimedFault fault = fault_of(FaultKind::jitter, 0, 1000);
  fault.fault.message = identifier<can::WheelState>;
  FaultRig rig(fault);
  SeatFrames seat;
  std::multiset<std::int32_t> came;
  bool several = false;
  for (std::uint32_t tick = 0; tick < 1010; ++tick) {
    const auto passed = rig.pass(tick, tick < 1000 ? seat.at(tick) : std::vector<can::Frame>());
    several = several || count_of(passed, identifier<can::WheelState>) > 1;
    for (const can::Frame& frame : passed) {
      if (const auto state = read<can::WheelState>(frame)) {
        came.insert(state->left_mm_s);
        ASSERT_LE(tick - static_cast<std::uint32_t>(state->left_mm_s), 5U);
      }
    }
  }
  EXPECT_EQ(came.size(), 1000U);
  EXPECT_TRUE(several);
}

TEST(FrameFault, AReplayShowsTheLastFramesBeforeItInTurn) {
  TimedFault fault = fault_of(FaultKind::replay, from, until);
  fault.fault.message = identifier<can::WheelState>;
  fault.fault.count = 3;
  FaultRig rig(fault);
  SeatFrames seat;
  for (std::uint32_t tick = 0; tick < until; ++tick) {
    const auto passed = rig.pass(tick, seat.at(tick));
    const std::uint32_t shown = tick < from ? tick : from - 3 + (tick - from) % 3;
    ASSERT_EQ(wheel_tick(passed), static_cast<std::int32_t>(shown)) << tick;
  }
}

TEST(FrameFault, AStuckOperatorFrameComesInEveryTick) {
  TimedFault fault = fault_of(FaultKind::replay, from, until);
  fault.fault.message = identifier<can::ModeCommand>;
  FaultRig rig(fault);
  can::SendCounter mode;
  const can::Frame arm = can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(can::Mode::arm)}, mode);
  rig.pass(0, {arm});
  EXPECT_EQ(rig.pass(from, {}), std::vector{arm});
  EXPECT_EQ(rig.pass(until - 1, {}), std::vector{arm});
  EXPECT_TRUE(rig.pass(until, {}).empty());
}

TEST(FrameFault, AMasqueradeIsHeardByBothUnderTheOtherIdentifier) {
  TimedFault fault = fault_of(FaultKind::masquerade, 0, 1);
  fault.fault.message = identifier<can::WheelState>;
  fault.fault.as = identifier<can::WheelCommand>;
  FaultRig rig(fault);
  SeatFrames seat;
  const auto frames = seat.at(0);
  const auto passed = rig.pass(0, frames);
  ASSERT_EQ(passed.size(), 3U);
  EXPECT_EQ(passed[0].id, identifier<can::WheelCommand>);
  EXPECT_EQ(passed[0].data, frames[0].data);
  EXPECT_EQ(passed[1], frames[0]);
  ASSERT_EQ(rig.answer.size(), 1U);
  EXPECT_EQ(rig.answer[0].id, identifier<can::WheelCommand>);
}

TEST(FrameFault, ADuplicateComesBeforeItsOriginalAndSyncStaysAlone) {
  TimedFault fault = fault_of(FaultKind::duplicate, 0, 1);
  fault.fault.count = 4;
  FaultRig rig(fault);
  SeatFrames seat;
  const auto passed = rig.pass(0, seat.at(0));
  EXPECT_EQ(count_of(passed, identifier<can::WheelState>), 5U);
  EXPECT_EQ(count_of(passed, identifier<can::Sync>), 1U);
  EXPECT_TRUE(can::is<can::Sync>(passed.back()));
}

TEST(FrameFault, ReorderingKeepsTheFramesAndTheEndOfTheTick) {
  FaultRig rig(fault_of(FaultKind::reorder, 0, 100));
  std::set<std::uint16_t> firsts;
  can::SendCounter sync;
  for (std::uint32_t tick = 0; tick < 100; ++tick) {
    std::vector<can::Frame> frames(4);
    for (std::uint16_t i = 0; i < 4; ++i) {
      frames[i].id = static_cast<std::uint16_t>(0x100 + i);
    }
    frames.push_back(can::send(can::Sync{}, sync));
    const auto passed = rig.pass(tick, frames);
    std::multiset<std::uint16_t> ids;
    for (const can::Frame& frame : passed) {
      ids.insert(frame.id);
    }
    ASSERT_EQ(ids.size(), 5U);
    ASSERT_TRUE(can::is<can::Sync>(passed.back()));
    firsts.insert(passed.front().id);
  }
  EXPECT_EQ(firsts.size(), 4U);
}

TEST(FrameFault, BabbleIsRandomBytesOfTheMessagesLengthOnBothSides) {
  TimedFault fault = fault_of(FaultKind::babble, 0, 100);
  fault.fault.message = identifier<can::ModeCommand>;
  FaultRig rig(fault);
  std::set<std::array<std::uint8_t, 8>> data;
  for (std::uint32_t tick = 0; tick < 100; ++tick) {
    const auto passed = rig.pass(tick, {});
    ASSERT_EQ(passed.size(), 8U);
    ASSERT_EQ(rig.answer, passed);
    for (const can::Frame& frame : passed) {
      ASSERT_EQ(frame.id, identifier<can::ModeCommand>);
      ASSERT_EQ(frame.length, can::layout<can::ModeCommand>.info.length);
      data.insert(frame.data);
    }
  }
  EXPECT_GT(data.size(), 790U);
}

TEST(FrameFault, AnEmergencyStopComesOnceBehindItsBurst) {
  TimedFault fault = fault_of(FaultKind::emergency_stop, from, from + 1);
  fault.fault.count = 50;
  FaultRig rig(fault);
  EXPECT_TRUE(rig.pass(from - 1, {}).empty());
  const auto passed = rig.pass(from, {});
  ASSERT_EQ(passed.size(), 51U);
  EXPECT_EQ(count_of(passed, identifier<can::EmergencyStop>), 1U);
  EXPECT_TRUE(read<can::EmergencyStop>(passed.back()));
  EXPECT_TRUE(rig.pass(from + 1, {}).empty());
}

// What SYNC tells in a tick, with each of its counters one more than the last.
std::vector<std::int32_t> told(FaultRig& rig, SeatFrames& seat, std::uint32_t tick) {
  std::vector<std::int32_t> ticks;
  for (const can::Frame& frame : rig.pass(tick, seat.at(tick))) {
    if (const auto sync = read<can::Sync>(frame)) {
      ticks.push_back(sync->tick);
    }
  }
  return ticks;
}

using Ticks = std::vector<std::int32_t>;

TEST(SyncFault, EachChangesTheTickAsItSays) {
  const auto at = [](FaultKind kind, std::uint32_t tick, std::uint32_t count) {
    TimedFault fault = fault_of(kind, from, until);
    fault.fault.count = count;
    FaultRig rig(fault);
    SeatFrames seat;
    for (std::uint32_t before = 1; before < tick; ++before) {
      told(rig, seat, before);
    }
    return told(rig, seat, tick);
  };
  EXPECT_EQ(at(FaultKind::sync_freeze, from + 9, 1), Ticks{from});
  EXPECT_EQ(at(FaultKind::sync_backward, from + 9, 12), Ticks{from + 9 - 12});
  EXPECT_EQ(at(FaultKind::sync_wrap, from + 2, 3), Ticks{0x7FFFFFFF - 1});
  EXPECT_EQ(at(FaultKind::sync_wrap, from + 4, 3), Ticks{0});
  EXPECT_EQ(at(FaultKind::sync_restart, from, 1), Ticks{0});
  EXPECT_EQ(at(FaultKind::sync_restart, from + 1, 1), Ticks{from + 1});
  EXPECT_EQ(at(FaultKind::sync_repeat, from + 1, 2), (Ticks{from + 1, from + 1, from + 1}));
  EXPECT_EQ(at(FaultKind::second_simulator, from + 1, 1), (Ticks{from + 1, 2}));
  EXPECT_EQ(at(FaultKind::sync_freeze, until, 1), Ticks{until});
}

TEST(SyncFault, RepeatedFramesAreNumberedOn) {
  TimedFault fault = fault_of(FaultKind::sync_repeat, from, until);
  FaultRig rig(fault);
  SeatFrames seat;
  int last = -1;
  for (std::uint32_t tick = 1; tick < until + 10; ++tick) {
    for (const can::Frame& frame : rig.pass(tick, seat.at(tick))) {
      if (can::is<can::Sync>(frame)) {
        ASSERT_TRUE(last < 0 || can::counter_of(frame) == (last + 1) % 16) << tick;
        last = can::counter_of(frame);
      }
    }
  }
}

}  // namespace
}  // namespace striker::sil

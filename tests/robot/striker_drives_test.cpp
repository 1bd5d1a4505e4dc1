// SPDX-License-Identifier: Apache-2.0
// The drives' own watchdog and receive checks.
#include "sil/robot/striker_drives.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace striker::sil {
namespace {

// Commands until they are believed; the last of them at tick 99.
class Driven {
 public:
  StrikerDrives drives;
  can::SendCounter counter;

  Driven() {
    for (std::uint32_t tick = 80; tick < 100; ++tick) {
      drives.take(command(300), tick);
    }
  }
  can::Frame command(std::int32_t torque_mNm) {
    return can::send(can::WheelCommand{.left_torque_mNm = torque_mNm, .right_torque_mNm = torque_mNm},
                     counter);
  }
};

TEST(StrikerDrives, CutTheTorqueTenMillisecondsAfterTheLastCommand) {
  EXPECT_TRUE(StrikerDrives().cut(0)) << "no command yet";
  Driven driven;
  for (std::uint32_t tick = 99; tick < 109; ++tick) {
    EXPECT_FALSE(driven.drives.cut(tick));
  }
  EXPECT_TRUE(driven.drives.cut(109));
}

TEST(StrikerDrives, ABadCommandIsIgnoredCountedAndFeedsNothing) {
  Driven driven;
  const std::uint64_t before = driven.drives.ignored();
  can::Frame bad = driven.command(-300);
  bad.data[3] ^= 0x10U;
  driven.drives.take(bad, 105);
  EXPECT_EQ(driven.drives.orders()[0].torque_Nm, 300 * 1e-3);
  EXPECT_EQ(driven.drives.ignored(), before + 1);
  EXPECT_TRUE(driven.drives.cut(109));
}

// A hung controller that sends one frame, or a few, again and again.
TEST(StrikerDrives, AFrozenCommandDrivesNothing) {
  for (std::size_t frames = 1; frames <= 11; ++frames) {
    for (const std::uint32_t period : {1U, 2U, 5U, 10U}) {
      Driven driven;
      std::vector<can::Frame> old;
      for (std::size_t i = 0; i < frames; ++i) {
        old.push_back(driven.command(400));
      }
      std::uint32_t driven_ticks = 0;
      for (std::uint32_t tick = 100; tick < 60'100; ++tick) {
        if (tick % period == 0) {
          driven.drives.take(old[tick / period % frames], tick);
        }
        driven_ticks += driven.drives.cut(tick) ? 0U : 1U;
      }
      // What was good ends with its time-out; nothing is believed again.
      EXPECT_LE(driven_ticks, 10U + frames * period) << frames << " frames every " << period << " ms";
    }
  }
}

TEST(StrikerDrives, ACommandThatWaitedIsAsOldAsItIs) {
  Driven driven;
  can::Frame late = driven.command(300);
  late.age_ms = 9;
  driven.drives.take(late, 108);
  EXPECT_FALSE(driven.drives.cut(108));
  EXPECT_TRUE(driven.drives.cut(109));
}

TEST(StrikerDrives, AControllerThatComesBackIsBelievedAfterTwelveCommandsFromAnyCounter) {
  for (std::uint8_t start = 0; start < 16; ++start) {
    Driven driven;
    driven.counter.next = start;
    for (std::uint32_t tick = 500; tick < 511; ++tick) {
      driven.drives.take(driven.command(7), tick);
      ASSERT_TRUE(driven.drives.cut(tick)) << int{start} << " " << tick;
    }
    driven.drives.take(driven.command(7), 511);
    driven.drives.take(driven.command(7), 512);  // after the very last counter, the first is a repetition
    EXPECT_FALSE(driven.drives.cut(512)) << int{start};
    EXPECT_EQ(driven.drives.orders()[0].torque_Nm, 7 * 1e-3);
  }
}

// Stated from outside: whoever repeats old commands beside a controller that says torque 0 in every tick gets torque for one
// tick in a hundred at most.
TEST(StrikerDrives, OldCommandsBesideASenderWhoSaysZeroDriveForATickInAHundred) {
  for (std::size_t frames = 1; frames <= 5; ++frames) {
    for (std::uint32_t period = 1; period <= 60; ++period) {
      for (std::uint32_t phase = 0; phase < period; phase += 1 + period / 16) {
        Driven driven;
        std::vector<can::Frame> old;
        for (std::size_t i = 0; i < frames; ++i) {
          old.push_back(driven.command(400));
        }
        std::size_t next = 0;
        std::uint32_t driven_ticks = 0;
        for (std::uint32_t tick = 100; tick < 700; ++tick) {
          const bool first = tick % 2 == 0;  // before the sender's frame, or behind it
          const bool comes = tick % period == phase;
          if (comes && first) {
            driven.drives.take(old[next++ % frames], tick);
          }
          driven.drives.take(driven.command(0), tick);
          if (comes && !first) {
            driven.drives.take(old[next++ % frames], tick);
          }
          const bool drives = !driven.drives.cut(tick) && driven.drives.orders()[0].torque_Nm != 0.0;
          driven_ticks += drives && tick > 130 ? 1 : 0;
        }
        ASSERT_LE(driven_ticks, 6U) << frames << " frames every " << period << " ms at " << phase;
      }
    }
  }
}

TEST(StrikerDrives, OldCommandsAtPowerOnDriveNothing) {
  for (std::size_t frames = 1; frames <= 11; ++frames) {
    Driven recorded;
    std::vector<can::Frame> old;
    for (std::size_t i = 0; i < frames; ++i) {
      old.push_back(recorded.command(400));
    }
    StrikerDrives drives;
    for (std::uint32_t tick = 0; tick < 1'000; ++tick) {
      drives.take(old[tick % frames], tick);
      ASSERT_TRUE(drives.cut(tick)) << frames << " frames, tick " << tick;
    }
  }
}

TEST(StrikerDrives, OrdersAreInNewtonMetresAndMetresPerSecond) {
  Driven driven;
  driven.drives.take(can::send(can::WheelCommand{.left_torque_mNm = -250,
                                                 .right_torque_mNm = 1,
                                                 .left_set_point_2mm_s = 600,
                                                 .right_set_point_2mm_s = -1},
                               driven.counter),
                     100);
  const WheelOrders& orders = driven.drives.orders();
  EXPECT_DOUBLE_EQ(orders[0].torque_Nm, -0.25);
  EXPECT_DOUBLE_EQ(orders[1].torque_Nm, 0.001);
  EXPECT_DOUBLE_EQ(orders[0].rim_speed_m_s, 1.2);
  EXPECT_DOUBLE_EQ(orders[1].rim_speed_m_s, -0.002);
}

TEST(StrikerDrives, AReportIsOneFrameWithBothSpeedsAndTheCut) {
  Driven driven;
  EXPECT_EQ(StrikerDrives().ignored(), 0U);
  for (const std::uint32_t tick : {100U, 120U}) {
    std::vector<can::Frame> frames;
    driven.drives.report({.left_m_s = 1.2344, .right_m_s = -0.5}, tick, frames);
    ASSERT_EQ(frames.size(), 1U);
    can::WheelState state;
    ASSERT_EQ(can::receive(frames.front(), state), can::Verdict::accepted);
    EXPECT_EQ(state.left_mm_s, 1234);
    EXPECT_EQ(state.right_mm_s, -500);
    EXPECT_EQ(state.torque_cut, tick == 120 ? 1 : 0);
  }
}

// A report looks at the time-out as the torque does: it forgets a command with the tick that cuts, and not before.
TEST(StrikerDrives, AReportForgetsWithTheCut) {
  Driven driven;
  std::vector<can::Frame> frames;
  driven.drives.report({}, 108, frames);
  EXPECT_FALSE(driven.drives.cut(108));
  driven.drives.report({}, 109, frames);
  EXPECT_TRUE(driven.drives.cut(100)) << "a tick that comes again in 2^32";
}

TEST(StrikerDrives, NothingComesBackWhenTicksWrap) {
  Driven driven;
  std::vector<can::Frame> frames;
  driven.drives.report({}, 150, frames);
  for (std::uint32_t tick = 95; tick < 115; ++tick) {
    EXPECT_TRUE(driven.drives.cut(tick)) << "2^32 ticks later";
  }
}

}  // namespace
}  // namespace striker::sil

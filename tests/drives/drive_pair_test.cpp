// SPDX-License-Identifier: Apache-2.0
// What two drives of another make are to the controller (DrivePair) and to the command gate (DriveWatch), news by news.
#include "firmware/can/drives/drive_pair.hpp"

#include <gtest/gtest.h>

#include "firmware/safety/drive_watch.hpp"

namespace striker::can {
namespace {

DriveNews speed(std::size_t wheel, std::int32_t mm_s) {
  return {.wheel = wheel, .speed_mm_s = mm_s};
}
DriveNews state(std::size_t wheel, bool enabled) {
  return {.wheel = wheel, .is_enabled = enabled, .rests = !enabled};
}

class Pair : public testing::Test {
 protected:
  DrivePair pair;
  DriveReport report;
  std::uint32_t tick = 5'000;

  void tell(const DriveNews& news, std::uint32_t age = 0) {
    EXPECT_EQ(pair.take(news, tick - age, report), Verdict::accepted);
  }
  // A tick in which both tell that they are enabled.
  void enabled_tick() {
    tell(state(left_wheel, true));
    tell(state(right_wheel, true));
    EXPECT_EQ(pair.judge(tick), 0U);
    pair.enable(true);
    ++tick;
  }
  void drive() {
    for (int i = 0; i < 20; ++i) {
      enabled_tick();
    }
    ASSERT_TRUE(pair.follows());
  }
};

TEST_F(Pair, OneSpeedAloneIsNoReport) {
  tell(speed(right_wheel, -7));
  EXPECT_FALSE(report.is_whole);
  tell(speed(left_wheel, 5));
  EXPECT_TRUE(report.is_whole);
  EXPECT_EQ(report.speeds, (core::WheelSpeeds{5, -7}));
  tell(speed(left_wheel, 6));
  EXPECT_FALSE(report.is_whole) << "the right one's is used up";
}

TEST_F(Pair, SpeedsOfOtherTimesDoNotBelongTogether) {
  tell(speed(left_wheel, 5), 3);
  tell(speed(right_wheel, 5));
  EXPECT_FALSE(report.is_whole);
  tell(speed(left_wheel, 6), 2);
  EXPECT_TRUE(report.is_whole);
  tell(speed(right_wheel, 5), 3);
  tell(speed(left_wheel, 6));
  EXPECT_FALSE(report.is_whole);
  tell(speed(right_wheel, 6), 2);
  EXPECT_TRUE(report.is_whole);
  tell(speed(right_wheel, 7), 2);
  tell(speed(left_wheel, 7));
  EXPECT_TRUE(report.is_whole) << "2 ms apart, whichever came first";
}

TEST_F(Pair, WhatIsNotBelievedIsNotTaken) {
  tell(speed(left_wheel, 5));
  EXPECT_EQ(pair.take({.verdict = Verdict::out_of_range, .wheel = right_wheel}, tick, report),
            Verdict::out_of_range);
  EXPECT_TRUE(pair.invalid());
  tell(speed(right_wheel, 5));
  EXPECT_TRUE(report.is_whole);
  EXPECT_FALSE(pair.invalid());
}

TEST_F(Pair, FollowsWhenBothAreEnabledSinceItWasWanted) {
  EXPECT_EQ(pair.judge(tick), 0U);
  tell(state(left_wheel, true));
  tell(state(right_wheel, true));
  pair.enable(true);
  tick += 10;
  EXPECT_EQ(pair.judge(tick), 0U);
  EXPECT_FALSE(pair.follows()) << "what they told before does not count";
  tell(state(left_wheel, true));
  EXPECT_FALSE(pair.follows());
  tell(state(right_wheel, true));
  EXPECT_TRUE(pair.follows());
  pair.enable(false);
  EXPECT_FALSE(pair.follows());
}

TEST_F(Pair, NeitherFollowsInTheFirst8Milliseconds) {
  EXPECT_EQ(pair.judge(tick), 0U);
  pair.enable(true);
  for (std::uint32_t since = 0; since <= 8; ++since) {
    tell(state(left_wheel, true));
    tell(state(right_wheel, true));
    EXPECT_EQ(pair.judge(tick + since), 0U);
    EXPECT_EQ(pair.follows(), since == 8) << since;
  }
}

// While speeds may go on.
TEST_F(Pair, AStateThatIsNotToldIsAFaultWithinThreePeriods) {
  drive();
  std::uint32_t silent = 0;
  for (; pair.judge(tick + silent) == 0; ++silent) {
    ASSERT_LT(silent, 100U);
  }
  EXPECT_EQ(pair.judge(tick + silent), core::set_of(core::Fault::wheel_state_lost));
  EXPECT_EQ(silent + 1, 29U)
      << "since they told: more than two periods of 10 ms, with their jitter, and less than three";
}

TEST_F(Pair, OneThatIsNotEnabledAnyMoreIsAFaultAtOnce) {
  drive();
  tell(state(right_wheel, false));
  EXPECT_FALSE(pair.follows());
  EXPECT_EQ(pair.judge(tick), core::set_of(core::Fault::drives_cut));
  pair.enable(false);
  EXPECT_EQ(pair.judge(tick), 0U) << "nobody wants it";
}

TEST_F(Pair, OneThatFellInATickIsAFaultOfThatTickWhateverItTellsAfter) {
  for (const std::size_t wheel : {left_wheel, right_wheel}) {
    drive();
    tell(state(wheel, false));
    tell(state(wheel, true));
    EXPECT_EQ(pair.judge(tick), core::set_of(core::Fault::drives_cut)) << wheel;
    EXPECT_EQ(pair.judge(++tick), 0U) << wheel << ": it is enabled";
  }
}

TEST_F(Pair, ADriveHas40TicksToComeUp) {
  EXPECT_EQ(pair.judge(tick), 0U) << "nobody wants it, however long it has been silent";
  pair.enable(true);
  const std::uint32_t wanted_tick = tick;
  for (; tick <= wanted_tick + 40; ++tick) {
    tell(state(left_wheel, true));
    tell(state(right_wheel, false));
    EXPECT_EQ(pair.judge(tick), 0U) << tick - wanted_tick;
  }
  EXPECT_EQ(pair.judge(tick), core::set_of(core::Fault::drives_cut));
}

TEST_F(Pair, BeingWantedEndsNoSilenceButBeginsItsTime) {
  EXPECT_EQ(pair.judge(tick), 0U);
  pair.enable(true);
  EXPECT_EQ(pair.judge(tick + 28), 0U);
  EXPECT_EQ(pair.judge(tick + 29), core::set_of(core::Fault::wheel_state_lost));
}

TEST_F(Pair, RestsAsItToldLast) {
  EXPECT_TRUE(pair.rests(left_wheel)) << "what told nothing";
  tell(state(left_wheel, true));
  EXPECT_FALSE(pair.rests(left_wheel));
  EXPECT_TRUE(pair.rests(right_wheel));
  tell(state(left_wheel, false));
  EXPECT_TRUE(pair.rests(left_wheel));
}

TEST(FirstSpeeds, AreNoReportAlone) {
  for (const std::size_t wheel : {left_wheel, right_wheel}) {
    DrivePair pair;
    DriveReport report;
    EXPECT_EQ(pair.take(speed(wheel, 5), 1, report), Verdict::accepted);
    EXPECT_FALSE(report.is_whole) << wheel;
  }
}

TEST(DriveWatch, AsksForSpeedsAndStatesOfBothWithTheirAges) {
  safety::DriveWatch watch;
  EXPECT_FALSE(watch.fresh(0, 25));
  EXPECT_FALSE(watch.enabled(0, 35));
  watch.take(speed(left_wheel, 0), 100);
  watch.take(state(left_wheel, true), 100);
  EXPECT_FALSE(watch.fresh(100, 25));
  EXPECT_FALSE(watch.enabled(100, 35));
  watch.take(speed(right_wheel, 0), 101);
  watch.take(state(right_wheel, true), 101);
  EXPECT_TRUE(watch.fresh(125, 25));
  EXPECT_FALSE(watch.fresh(126, 25));
  EXPECT_TRUE(watch.enabled(135, 35));
  EXPECT_FALSE(watch.enabled(136, 35));
  watch.take(state(left_wheel, true), 130);
  EXPECT_TRUE(watch.enabled(136, 35));
  EXPECT_FALSE(watch.enabled(137, 35)) << "the right one's";
  watch.take({.verdict = Verdict::wrong_length, .wheel = right_wheel, .is_enabled = true}, 137);
  EXPECT_FALSE(watch.enabled(137, 35)) << "a frame that is not believed";
}

// In any tick: which wheel it was makes no difference.
TEST(DriveWatch, WhoToldThatItIsNotEnabledIsNotInThatTick) {
  for (const std::size_t fallen : {left_wheel, right_wheel}) {
    safety::DriveWatch watch;
    watch.begin_tick();
    for (const std::size_t wheel : {left_wheel, right_wheel}) {
      watch.take(state(wheel, true), 100);
    }
    EXPECT_TRUE(watch.enabled(100, 35));
    watch.begin_tick();
    watch.take(state(fallen, false), 101);
    watch.take(state(fallen, true), 101);
    EXPECT_FALSE(watch.enabled(101, 35)) << fallen;
    watch.begin_tick();
    EXPECT_TRUE(watch.enabled(102, 35))
        << fallen << ": what it told last counts again; the controller has told a fault by then";
  }
}

TEST(DriveWatch, SpeedsAreNoStatesAndStatesNoSpeeds) {
  safety::DriveWatch watch;
  for (const std::size_t wheel : {left_wheel, right_wheel}) {
    watch.take(speed(wheel, 5), 100);
  }
  EXPECT_TRUE(watch.fresh(100, 25));
  EXPECT_FALSE(watch.enabled(100, 35));
  for (const std::size_t wheel : {left_wheel, right_wheel}) {
    watch.take(state(wheel, true), 120);
  }
  EXPECT_TRUE(watch.enabled(120, 35));
  EXPECT_FALSE(watch.fresh(126, 25)) << "the speeds are of tick 100";
}

}  // namespace
}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// The kernel's stamps on a clock that is set at will, read by a process that is interrupted at will.
#include "firmware/host/can/stamp_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <random>

namespace striker::host {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000 * ms;
constexpr std::int64_t epoch = 1'800'000'000 * s;

// True time is CLOCK_MONOTONIC's; the calendar is ahead of it by `ahead_ns`.
struct Machine {
  std::int64_t now_ns = 5 * s;
  std::int64_t ahead_ns = epoch;

  [[nodiscard]] std::int64_t stamp() const { return now_ns + ahead_ns; }
  ClockReading read(std::int64_t first_pause_ns = 30, std::int64_t second_pause_ns = 30) {
    ClockReading reading{.before_ns = now_ns};
    now_ns += first_pause_ns;
    reading.realtime_ns = stamp();
    now_ns += second_pause_ns;
    reading.after_ns = now_ns;
    return reading;
  }
};

TEST(StampClock, AStampIsTheTimeThatItWasTakenUpToAReadingsLength) {
  Machine machine;
  StampClock clock(machine.read());
  for (int i = 0; i < 1000; ++i) {
    machine.now_ns += ms;
    const std::int64_t came_ns = machine.now_ns;
    const std::int64_t stamp = machine.stamp();
    machine.now_ns += 1000;
    clock.take(machine.read());
    EXPECT_LE(clock.monotonic_ns(stamp), came_ns);
    EXPECT_GE(clock.monotonic_ns(stamp), came_ns - 60);
    clock.note_empty();
  }
}

TEST(StampClock, AReadingThatWasInterruptedMakesNoStampWorse) {
  Machine machine;
  StampClock clock(machine.read(200 * ms, 0));
  clock.take(machine.read());
  machine.now_ns += ms;
  const std::int64_t came_ns = machine.now_ns;
  const std::int64_t stamp = machine.stamp();
  clock.take(machine.read(300 * ms, 0));
  EXPECT_GE(clock.monotonic_ns(stamp), came_ns - 60);
  EXPECT_LE(clock.monotonic_ns(stamp), came_ns);
}

TEST(StampClock, AStepOfASecondMovesNoStampWhetherItWasTakenBeforeOrAfter) {
  for (const std::int64_t step : {-3600 * s, -s, -5 * ms, 5 * ms, s, 3600 * s}) {
    for (const bool is_before : {true, false}) {
      Machine machine;
      StampClock clock(machine.read());
      clock.take(machine.read());
      clock.note_empty();
      machine.now_ns += ms;
      machine.ahead_ns += is_before ? 0 : step;
      const std::int64_t came_ns = machine.now_ns;
      const std::int64_t stamp = machine.stamp();
      machine.ahead_ns += is_before ? step : 0;
      clock.take(machine.read());
      EXPECT_NEAR(static_cast<double>(clock.monotonic_ns(stamp)), static_cast<double>(came_ns), 100.0)
          << step;
    }
  }
}

TEST(StampClock, AStampThatFitsNoTimeIsTakenForTheOldestThatAFrameCanBe) {
  Machine machine;
  StampClock clock(machine.read());
  const std::int64_t opened_ns = 5 * s;
  machine.now_ns += ms;
  const std::int64_t stamp = machine.stamp();
  machine.now_ns += ms;
  clock.take(machine.read());
  EXPECT_EQ(clock.monotonic_ns(stamp + 60 * s), opened_ns);
  EXPECT_EQ(clock.monotonic_ns(stamp - 60 * s), opened_ns);
  EXPECT_EQ(clock.monotonic_ns(0), opened_ns);
}

// Steps, pauses, bursts and readings that are interrupted, all at random, thousands of times.
TEST(StampClock, WhateverIsSetNoTimeIsInTheFutureOrOffByMoreThanTheWindow) {
  std::mt19937_64 random(7);
  const auto draw = [&](std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random);
  };
  struct Waiting {
    std::int64_t came_ns;
    std::int64_t stamp;
  };
  Machine machine;
  StampClock clock(machine.read());
  std::deque<Waiting> queue;
  std::int64_t window_from_ns = 5 * s;
  std::int64_t reading_ns = window_from_ns;
  std::int64_t step_ns = window_from_ns;  // when the clock was set last
  int after_a_step = 0;
  for (int tick = 0; tick < 20'000; ++tick) {
    for (std::int64_t frames = draw(0, 6); frames > 0; --frames) {
      machine.now_ns += draw(0, draw(0, 99) == 0 ? 400 * ms : ms / 2);
      if (draw(0, 199) == 0) {
        machine.ahead_ns += draw(0, 1) == 0 ? draw(-3 * ms, 3 * ms) : draw(-3600 * s, 3600 * s);
        step_ns = machine.now_ns;
      }
      queue.push_back({machine.now_ns, machine.stamp()});
    }
    const std::size_t taken = std::min<std::size_t>(queue.size(), 4);
    const bool is_emptied = taken == queue.size();
    if (draw(0, 9) == 0) {  // between the read and the clocks
      machine.now_ns += draw(0, ms);
      queue.push_back({machine.now_ns, machine.stamp()});
    }
    const std::int64_t before_ns = reading_ns;
    const ClockReading reading = machine.read(draw(10, 100), draw(10, 100));
    clock.take(reading);
    reading_ns = reading.after_ns;
    for (std::size_t i = 0; i < taken; ++i) {
      const auto [came_ns, stamp] = queue.front();
      queue.pop_front();
      const std::int64_t got_ns = clock.monotonic_ns(stamp);
      EXPECT_LE(got_ns, reading_ns);
      EXPECT_LE(std::abs(got_ns - came_ns), reading_ns - window_from_ns);
      if (step_ns < window_from_ns) {
        EXPECT_LE(got_ns, came_ns);
        EXPECT_GE(got_ns, came_ns - 200);
      } else {
        ++after_a_step;
      }
    }
    if (is_emptied) {
      clock.note_empty();
      window_from_ns = before_ns;
    }
  }
  EXPECT_GT(after_a_step, 500);
}

TEST(StampClock, TheMachinesClocksAgreeWithThemselves) {
  const ClockReading first = read_clocks();
  StampClock clock(first);
  const ClockReading second = read_clocks();
  clock.take(read_clocks());
  EXPECT_LE(first.after_ns, second.before_ns);
  EXPECT_LE(clock.monotonic_ns(second.realtime_ns), second.after_ns);
  EXPECT_GE(clock.monotonic_ns(second.realtime_ns), first.before_ns);
}

}  // namespace
}  // namespace striker::host

// SPDX-License-Identifier: Apache-2.0
// When ticks may begin, on a clock of its own.
#include "sil/view/time_gate.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

constexpr std::int64_t ms = 1'000'000;

class LogicalClock final : public host::AbsoluteClock {
 public:
  std::int64_t time_ns = 1;
  int sleeps = 0;

  std::int64_t now_ns() override { return time_ns; }
  void sleep_until_ns(std::int64_t until_ns) override {
    ++sleeps;
    time_ns = std::max(time_ns, until_ns);
  }
};

std::int64_t time_of(double speed, int ticks) {
  LogicalClock clock;
  TimeGate gate(clock, speed);
  const std::int64_t begin_ns = clock.time_ns;
  for (int i = 0; i < ticks; ++i) {
    gate.pace();
  }
  return clock.time_ns - begin_ns;
}

TEST(TimeGate, KeepsEverySpeedOnAverage) {
  for (const double speed : {0.1, 0.5, 1.0, 3.0, 100.0, 1000.0}) {
    EXPECT_NEAR(static_cast<double>(time_of(speed, 10'000)), 10'000.0 * ms / speed, ms / std::min(speed, 1.0))
        << speed;
  }
}

TEST(TimeGate, AsFastAsItGoesNeverSleepsAndAsksNoClock) {
  EXPECT_EQ(time_of(0.0, 10'000), 0);
}

TEST(TimeGate, PausedNothingPassesButSteps) {
  LogicalClock clock;
  TimeGate gate(clock, 1.0);
  EXPECT_TRUE(gate.is_open());
  gate.pause();
  EXPECT_FALSE(gate.is_open());
  gate.step(2);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(gate.is_open());
    gate.pace();
  }
  EXPECT_FALSE(gate.is_open());
  EXPECT_TRUE(gate.is_paused());
  gate.step(5);
  gate.pause();
  EXPECT_FALSE(gate.is_open()) << "a pause ends the steps before it";
  gate.run();
  EXPECT_TRUE(gate.is_open());
  EXPECT_FALSE(gate.is_paused());
}

TEST(TimeGate, APauseIsNotCaughtUpWithNorLateness) {
  LogicalClock clock;
  TimeGate gate(clock, 1.0);
  gate.pace();
  gate.pause();
  clock.time_ns += 5'000 * ms;
  gate.run();
  gate.pace();
  gate.pace();
  EXPECT_EQ(clock.time_ns, 1 + 5'001 * ms);
  EXPECT_EQ(gate.take_lateness_max_us(), 0);
}

TEST(TimeGate, ShortDelaysAreCaughtUpWithAndLongOnesAreNot) {
  LogicalClock clock;
  TimeGate gate(clock, 1.0);
  gate.pace();
  clock.time_ns += 50 * ms;
  for (int i = 0; i < 50; ++i) {
    gate.pace();
  }
  EXPECT_EQ(clock.time_ns, 1 + 50 * ms);
  EXPECT_EQ(gate.take_lateness_max_us(), 49'000);
  EXPECT_EQ(gate.take_lateness_max_us(), 0) << "since it was asked before";
  clock.time_ns += 1'000 * ms;
  gate.pace();
  gate.pace();
  EXPECT_EQ(clock.time_ns, 1 + 1'051 * ms);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Periodic absolute deadlines on a clock, which a test may replace by a logical one.
#pragma once

#include <cstdint>
#include <ctime>

namespace striker::host {

class AbsoluteClock {
 public:
  virtual ~AbsoluteClock() = default;
  virtual std::int64_t now_ns() = 0;
  // Returns at once if the time has passed.
  virtual void sleep_until_ns(std::int64_t time_ns) = 0;
};

// CLOCK_MONOTONIC; sleeps with clock_nanosleep(TIMER_ABSTIME).
class MonotonicClock final : public AbsoluteClock {
 public:
  std::int64_t now_ns() override;
  void sleep_until_ns(std::int64_t time_ns) override;
};

// A late wake-up skips the whole periods that it missed: they never run in a burst, and the deadlines stay on
// their grid.
class PeriodicClock {
 public:
  PeriodicClock(AbsoluteClock& clock, std::int64_t period_ns)
      : clock_(&clock), period_ns_(period_ns), next_ns_(clock.now_ns()) {}

  struct Wake {
    std::uint32_t tick;        // periods since the start; skipped ones count
    std::int64_t lateness_ns;  // after the deadline that it waited for
    std::uint32_t missed;      // whole periods of that lateness: skipped
  };

  // Sleeps to the next deadline.
  Wake wait() {
    next_ns_ += period_ns_;
    clock_->sleep_until_ns(next_ns_);
    const std::int64_t lateness_ns = clock_->now_ns() - next_ns_;
    const auto missed = static_cast<std::uint32_t>(lateness_ns < 0 ? 0 : lateness_ns / period_ns_);
    next_ns_ += missed * period_ns_;
    tick_ += 1 + missed;
    return {tick_, lateness_ns, missed};
  }

 private:
  AbsoluteClock* clock_;
  std::int64_t period_ns_;
  std::int64_t next_ns_;
  std::uint32_t tick_ = 0;
};

}  // namespace striker::host

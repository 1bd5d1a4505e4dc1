// What a Linux process can ask of the kernel to be on time, and an absolute-deadline clock.
#pragma once

#include <cstdint>
#include <ctime>
#include <string>

namespace striker::linux_port {

inline constexpr std::int64_t period_ns = 1'000'000;  // the controller's tick

// SCHED_FIFO at this priority, and all memory locked. Returns what was refused and why, or nothing.
[[nodiscard]] std::string ask_for_real_time(int priority);

// CLOCK_MONOTONIC in ns.
[[nodiscard]] std::int64_t monotonic_ns();

// Periodic absolute deadlines. A late wake-up skips whole periods: it never runs them in a burst.
class PeriodicClock {
 public:
  PeriodicClock();

  struct Wake {
    std::uint32_t tick;        // periods since the start; skipped ones count
    std::int64_t lateness_ns;  // after the deadline that it waited for
    std::uint32_t missed;      // whole periods of that lateness: skipped
  };

  // Sleeps to the next deadline.
  Wake wait();

 private:
  std::int64_t next_ns_;
  std::uint32_t tick_ = 0;
};

}  // namespace striker::linux_port

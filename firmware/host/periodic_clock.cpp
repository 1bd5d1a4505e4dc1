// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/periodic_clock.hpp"

#include <cerrno>

namespace striker::host {

namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * ns_per_s + now.tv_nsec;
}

void MonotonicClock::sleep_until_ns(std::int64_t time_ns) {
  const timespec deadline{time_ns / ns_per_s, time_ns % ns_per_s};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace striker::host

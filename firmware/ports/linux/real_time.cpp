#include "ports/linux/real_time.hpp"

#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>

namespace striker::linux_port {

namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

}  // namespace

std::string ask_for_real_time(int priority) {
  std::string refused;
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) {
    refused += "SCHED_FIFO priority " + std::to_string(priority) + " refused (" + std::strerror(errno) + ")";
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    refused +=
        std::string(refused.empty() ? "" : "; ") + "locked memory refused (" + std::strerror(errno) + ")";
  }
  return refused;
}

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * ns_per_s + now.tv_nsec;
}

PeriodicClock::PeriodicClock() : next_ns_(monotonic_ns()) {}

PeriodicClock::Wake PeriodicClock::wait() {
  next_ns_ += period_ns;
  const timespec deadline{next_ns_ / ns_per_s, next_ns_ % ns_per_s};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
  const std::int64_t lateness_ns = monotonic_ns() - next_ns_;
  const auto missed = static_cast<std::uint32_t>(lateness_ns / period_ns);
  next_ns_ += missed * period_ns;
  tick_ += 1 + missed;
  return {tick_, lateness_ns, missed};
}

}  // namespace striker::linux_port

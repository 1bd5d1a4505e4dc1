// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/stamp_clock.hpp"

#include <algorithm>
#include <ctime>

namespace striker::host {

namespace {

std::int64_t now_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

}  // namespace

ClockReading read_clocks() {
  ClockReading reading;
  reading.before_ns = now_ns(CLOCK_MONOTONIC);
  reading.realtime_ns = now_ns(CLOCK_REALTIME);
  reading.after_ns = now_ns(CLOCK_MONOTONIC);
  return reading;
}

StampClock::StampClock(const ClockReading& first)
    : offset_(offset_of(first)),
      before_step_(offset_),
      from_ns_(first.before_ns),
      earlier_ns_(first.before_ns),
      now_ns_(first.after_ns) {}

StampClock::Offset StampClock::offset_of(const ClockReading& reading) {
  return {reading.realtime_ns - reading.after_ns, reading.realtime_ns - reading.before_ns};
}

void StampClock::take(const ClockReading& now) {
  const Offset seen = offset_of(now);
  const Offset both{std::max(offset_.least_ns, seen.least_ns),
                    std::min(offset_.greatest_ns, seen.greatest_ns)};
  if (both.least_ns <= both.greatest_ns) {
    offset_ = both;
  } else {
    before_step_ = offset_;
    offset_ = seen;
  }
  earlier_ns_ = now_ns_;
  now_ns_ = now.after_ns;
}

bool StampClock::covers(std::int64_t stamp_ns) const {
  return stamp_ns - offset_.greatest_ns <= now_ns_;
}

std::int64_t StampClock::monotonic_ns(std::int64_t stamp_ns) const {
  for (const Offset& offset : {offset_, before_step_}) {
    const std::int64_t earliest_ns = stamp_ns - offset.greatest_ns;
    const std::int64_t latest_ns = stamp_ns - offset.least_ns;
    if (latest_ns >= from_ns_ && earliest_ns <= now_ns_) {
      return std::max(earliest_ns, from_ns_);
    }
  }
  return from_ns_;
}

}  // namespace striker::host

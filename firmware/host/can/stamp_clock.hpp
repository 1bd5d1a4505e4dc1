// SPDX-License-Identifier: Apache-2.0
// When a frame came, by CLOCK_MONOTONIC. The kernel stamps it with CLOCK_REALTIME, which NTP or an operator may set at
// any moment: a stamp that is compared with a clock of another time is off by the whole step.
//
// How far one clock is ahead of the other is constant between two steps (rate corrections concern both), so that each
// reading of both narrows the same interval, and one that does not fit it tells of a step. A stamp is then of before
// or after the step: of the two times that it can mean, the one counts at which a frame could have come. Whatever was
// set, and how often, the error is less than the window between the reading before the queue was last empty and now;
// without a step in that window it is less than a reading took. No time is ever in the future.
#pragma once

#include <cstdint>

namespace striker::host {

// One clock between two looks at the other.
struct ClockReading {
  std::int64_t before_ns = 0;  // CLOCK_MONOTONIC
  std::int64_t realtime_ns = 0;
  std::int64_t after_ns = 0;  // CLOCK_MONOTONIC
};

[[nodiscard]] ClockReading read_clocks();

class StampClock {
 public:
  // Frames come after this reading.
  explicit StampClock(const ClockReading& first);

  // A reading that is later than the frames whose stamps are to be converted.
  void take(const ClockReading& now);

  // Whether the last reading is later than this stamp, as far as the clock was not set since.
  [[nodiscard]] bool covers(std::int64_t stamp_ns) const;

  // The time by CLOCK_MONOTONIC, at most the last reading's. Of the times that fit a stamp it is the earliest.
  [[nodiscard]] std::int64_t monotonic_ns(std::int64_t stamp_ns) const;

  // When the last reading was taken, by CLOCK_MONOTONIC.
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }

  // After the conversion: the queue was empty at some time since the last reading but one.
  void note_empty() { from_ns_ = earlier_ns_; }

 private:
  // CLOCK_REALTIME less CLOCK_MONOTONIC.
  struct Offset {
    std::int64_t least_ns;
    std::int64_t greatest_ns;
  };
  static Offset offset_of(const ClockReading& reading);

  Offset offset_;
  Offset before_step_;
  std::int64_t from_ns_;     // no frame that waits came before
  std::int64_t earlier_ns_;  // the last reading but one
  std::int64_t now_ns_;
};

}  // namespace striker::host

// How many of the last 1,000 periods were missed, and whether that is too many.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace striker::linux_port {

class OverrunLimit {
 public:
  static constexpr std::uint32_t window_ticks = 1000;

  explicit OverrunLimit(std::uint32_t limit) : limit_(limit) {}

  // Once a wake-up: it is tick `tick`, and the `missed` ticks before it were skipped. True while more than
  // the limit were missed within the window.
  bool exceeded_by(std::uint32_t tick, std::uint32_t missed) {
    const std::uint32_t passed = missed < window_ticks ? missed + 1 : window_ticks;
    for (std::uint32_t back = 0; back < passed; ++back) {
      bool& was_missed = missed_[(tick - back) % window_ticks];
      count_ -= was_missed ? 1 : 0;
      was_missed = back != 0;
      count_ += was_missed ? 1 : 0;
    }
    return count_ > limit_;
  }

 private:
  std::uint32_t limit_;
  std::uint32_t count_ = 0;
  std::array<bool, window_ticks> missed_{};
};

}  // namespace striker::linux_port

// SPDX-License-Identifier: Apache-2.0
// How many of the last 1,000 ticks were missed, and whether that is too many.
//
// The window slides in blocks of 100 ticks: it covers the block of the present tick and the nine before it,
// 901 to 1,000 ticks. Cost: ten additions, and ten bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace striker::loop {

class OverrunLimit {
 public:
  static constexpr std::uint32_t window_ticks = 1000;

  explicit constexpr OverrunLimit(std::uint32_t limit) : limit_(limit) {}

  // Once a wake-up: the `missed` ticks before it were skipped. True while more than the limit were missed
  // within the window.
  bool exceeded_by(std::uint32_t missed) {
    for (std::uint32_t back = std::min(missed, window_ticks); back > 0; --back) {
      count(true);
    }
    count(false);
    std::uint32_t total = 0;
    for (const std::uint8_t in_block : missed_) {
      total += in_block;
    }
    return total > limit_;
  }

 private:
  static constexpr std::uint32_t block_ticks = 100;
  static constexpr std::uint32_t blocks = window_ticks / block_ticks;

  // Every tick once, in order: no number of a tick is needed, and none wraps.
  void count(bool was_missed) {
    if (++in_block_ > block_ticks) {
      in_block_ = 1;
      block_ = (block_ + 1) % blocks;
      missed_[block_] = 0;
    }
    missed_[block_] = static_cast<std::uint8_t>(missed_[block_] + (was_missed ? 1 : 0));
  }

  std::uint32_t limit_;
  std::uint32_t block_ = 0;     // of the present tick
  std::uint32_t in_block_ = 0;  // ticks counted in it
  std::array<std::uint8_t, blocks> missed_{};
};

}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// How long a CAN controller stays off its bus after bus-off: for drivers whose hardware comes back as a fresh node,
// after 11 recessive bits.
//
// 2 ms at first, which is more than the 128 times 11 recessive bits of ISO 11898-1 (1.4 ms at 1 Mbit/s), and twice
// as long each time that it goes off again within 1 s of its return, up to 128 ms: a short circuit is not to be
// disturbed a hundred times a second.
#pragma once

#include <algorithm>
#include <cstdint>

namespace striker::bare_metal {

class BusOffPause {
 public:
  static constexpr std::uint32_t shortest_ticks = 2;
  static constexpr std::uint32_t longest_ticks = 128;
  static constexpr std::uint32_t forgotten_after_ticks = 1'000;

  // The controller went off.
  void begin(std::uint32_t tick) {
    const bool again = times_ != 0 && tick - end_ < forgotten_after_ticks;
    length_ = again ? std::min(2 * length_, longest_ticks) : shortest_ticks;
    end_ = tick + length_;
    ++times_;
  }

  // It may come back: at least `length` whole ticks have passed. Of a pause that has begun.
  [[nodiscard]] bool is_over(std::uint32_t tick) const { return tick - end_ - 1 < 0x7FFFFFFF; }

  // Since boot.
  [[nodiscard]] std::uint32_t times() const { return times_; }

 private:
  std::uint32_t length_ = 0;
  std::uint32_t end_ = 0;
  std::uint32_t times_ = 0;
};

}  // namespace striker::bare_metal

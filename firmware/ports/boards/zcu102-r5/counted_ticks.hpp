// SPDX-License-Identifier: Apache-2.0
// Ticks from a counter that runs freely and wraps: it misses nothing where it is asked at least once a turn.
#pragma once

#include <algorithm>
#include <cstdint>

namespace striker::zcu102 {

class CountedTicks {
 public:
  // `mask`: the bits that the counter has, from the lowest. Tick 0 begins at `count`.
  constexpr CountedTicks(std::uint32_t mask, std::uint32_t counts_a_tick, std::uint32_t count)
      : mask_(mask), counts_a_tick_(counts_a_tick), tick_at_(count) {}

  std::uint32_t ticks(std::uint32_t count) {
    const std::uint32_t passed = since_tick(count) / counts_a_tick_;
    ticks_ += passed;
    tick_at_ += passed * counts_a_tick_;
    return ticks_;
  }

  // In its upper half the counter is due to begin anew at 0, long before it wraps.
  [[nodiscard]] bool is_due_to_restart(std::uint32_t count) const { return count > mask_ / 2; }
  // It did, where it stood at `count`.
  void restart(std::uint32_t count) { tick_at_ -= count; }

  [[nodiscard]] std::uint32_t since_tick_us(std::uint32_t count) const {
    constexpr std::uint32_t greatest = 0xFFFFFFFF / 1'000;
    return std::min(since_tick(count), greatest) * 1'000 / counts_a_tick_;
  }

 private:
  [[nodiscard]] std::uint32_t since_tick(std::uint32_t count) const { return (count - tick_at_) & mask_; }

  std::uint32_t mask_;
  std::uint32_t counts_a_tick_;
  std::uint32_t tick_at_;
  std::uint32_t ticks_ = 0;
};

}  // namespace striker::zcu102

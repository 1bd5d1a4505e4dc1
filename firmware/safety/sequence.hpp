// SPDX-License-Identifier: Apache-2.0
// The gate's own judgement of a protected message: fresh is what came after a streak of correct frames whose
// counters rose by 1 to 3 each.
//
// A set of `least_streak` frames or fewer that repeats for ever breaks the streak once a round, and is never fresh.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/e2e.hpp"

namespace striker::safety {

template <std::uint32_t least_streak>
class Sequence {
 public:
  // The frame's counter, or nothing if its protection was not correct.
  void take(std::optional<std::uint8_t> counter, std::uint32_t received_tick) {
    const std::uint32_t step = counter ? (*counter - last_) & (can::counter_modulus - 1U) : 0;
    last_ = counter.value_or(last_);
    const bool rose = step >= 1 && step <= greatest_step;
    streak_ = !rose ? 0 : streak_ < least_streak ? streak_ + 1 : least_streak;
    if (streak_ == least_streak) {
      ever_fresh_ = true;
      fresh_tick_ = received_tick;
    }
  }

  // Once it was too old it has to come again: the account is asked in every tick that moves.
  [[nodiscard]] bool fresh(std::uint32_t tick, std::uint32_t limit_ticks) const {
    return ever_fresh_ && tick - fresh_tick_ <= limit_ticks;
  }

 private:
  static constexpr std::uint32_t greatest_step = 3;

  std::uint32_t fresh_tick_ = 0;
  std::uint32_t streak_ = 0;
  std::uint8_t last_ = 0;
  bool ever_fresh_ = false;
};

}  // namespace striker::safety

// SPDX-License-Identifier: Apache-2.0
// The gate's own judgement of a protected message: fresh is what came after a streak of correct frames whose
// counters rose by 1 to 3 each, as long as no more than `most_missed` of the sender's are missing in each streak.
//
// A set of frames that repeats for ever, in whatever order, comes back to its first counter with every round, and has gone
// the whole circle of 16 for it. One of `least_streak - 1` frames or fewer does so within a streak, and misses more than
// 16 - `least_streak`: with `most_missed` at that, it is fresh for a streak at most.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/e2e.hpp"

namespace striker::safety {

template <std::uint32_t least_streak, std::uint32_t most_missed>
class Sequence {
 public:
  // The frame's counter, or nothing if its protection was not correct.
  [[gnu::noinline]] void take(std::optional<std::uint8_t> counter, std::uint32_t received_tick) {
    const std::uint32_t step = counter ? (*counter - last_) & (can::counter_modulus - 1U) : 0;
    last_ = counter.value_or(last_);
    const bool rose = step >= 1 && step <= greatest_step;
    missed_ += rose ? step - 1 : 0;
    if (!rose || missed_ > most_missed) {
      break_off();
      return;
    }
    ++streak_;
    if (streak_ == least_streak) {
      is_whole_ = true;
      streak_ = 0;
      missed_ = 0;
    }
    if (is_whole_) {
      ever_fresh_ = true;
      fresh_tick_ = received_tick;
    }
  }

  // The last frame came in a streak.
  [[nodiscard]] bool goes_on() const { return is_whole_; }

  // Once it was too old it has to come again: the account is asked in every tick that moves.
  [[nodiscard]] bool fresh(std::uint32_t tick, std::uint32_t limit_ticks) const {
    return ever_fresh_ && tick - fresh_tick_ <= limit_ticks;
  }

 private:
  static constexpr std::uint32_t greatest_step = 3;

  void break_off() {
    is_whole_ = false;
    streak_ = 0;
    missed_ = 0;
  }

  std::uint32_t fresh_tick_ = 0;
  std::uint32_t streak_ = 0;  // frames of the one that goes on,
  std::uint32_t missed_ = 0;  // and how many of the sender's are missing in it
  std::uint8_t last_ = 0;
  bool is_whole_ = false;  // the streak before it was, without a break since
  bool ever_fresh_ = false;
};

}  // namespace striker::safety

// SPDX-License-Identifier: Apache-2.0
// When the policy decides: once every `decision_period_ticks`, in phase with the camera as long as it can.
//
// A new picture within `decision_window_ticks` of the expected time decides in its own tick and restarts the
// count. Without one the count runs free, and decides on extrapolated positions, until the freshness limit
// ends that elsewhere. A picture that comes just after such a decision makes that decision again, with better figures;
// the count restarts with it.
//
// With a camera of another rate the count always runs free, from the first picture on: to follow pictures that are not
// due with a decision would change its period, and the newest one is led on by less than the time between two.
#pragma once

#include <cstdint>

#include "firmware/core/tick.hpp"

namespace striker::core {

inline constexpr std::uint32_t decision_window_ticks = 5;

// `provisional`: extrapolated, and a picture within the window makes it `again`.
enum class DecisionDue : std::uint8_t { no, on_picture, extrapolated, provisional, again };

class DecisionClock {
 public:
  // At arming: waits for the first picture.
  void restart() { *this = {}; }

  // A motion was ordered: its first decision is due in this tick, whatever the phase, and the next ones follow it.
  void make_due(std::uint32_t tick) {
    awaits_first_picture_ = 0;
    decision_tick_ = tick - decision_period_ticks;
  }

  // The first picture since `restart` has come.
  [[nodiscard]] bool started() const { return awaits_first_picture_ == 0; }

  // Once a tick, while armed.
  [[nodiscard]] DecisionDue at(std::uint32_t tick, bool new_picture, bool on_each_picture) {
    const std::uint32_t phase = tick - decision_tick_;
    const bool early_enough = phase >= decision_period_ticks - (on_each_picture ? decision_window_ticks : 0);
    const bool just_after = on_each_picture && last_extrapolated_ != 0 && phase <= decision_window_ticks;
    if (new_picture && (awaits_first_picture_ != 0 || early_enough || just_after)) {
      awaits_first_picture_ = 0;
      last_extrapolated_ = 0;
      decision_tick_ = tick;
      return just_after ? DecisionDue::again : DecisionDue::on_picture;
    }
    if (awaits_first_picture_ == 0 && phase >= decision_period_ticks) {
      last_extrapolated_ = 1;
      decision_tick_ = tick - phase % decision_period_ticks;
      return on_each_picture ? DecisionDue::provisional : DecisionDue::extrapolated;
    }
    return DecisionDue::no;
  }

 private:
  // Whole words: they are part of the sealed state (seal.hpp).
  std::uint32_t awaits_first_picture_ = 1;
  std::uint32_t last_extrapolated_ = 0;
  std::uint32_t decision_tick_ = 0;
};

}  // namespace striker::core

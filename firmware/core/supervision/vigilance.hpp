// SPDX-License-Identifier: Apache-2.0
// What the controller knows of the soundness of its inputs: how fresh they are, and how long something has been
// wrong with them. It names causes; the supervisor makes faults of them.
//
// All limits count ticks of 1 ms, and a jump of time counts as the ticks that it is.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/core/estimation/estimator.hpp"
#include "firmware/core/freshness.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/state.hpp"

namespace striker::core {

// A pressed stop holds this long after its last frame, so that a clear cannot overtake a button that repeats.
inline constexpr std::uint32_t stop_hold_ticks = 200;

// The dead man: armed for longer than this without a renewal is a fault. A kick takes 2 s.
inline constexpr std::uint32_t armed_limit_ticks = 10'000;

// The drives say so in their next frame, or they do not follow.
inline constexpr std::uint32_t drives_cut_limit_ticks = 20;

// Another controller on the bus is a cause for so long after its last frame.
inline constexpr std::uint32_t second_controller_hold_ticks = 1'000;

// Measured motions in a row.
inline constexpr std::uint32_t mismatch_limit = 2;

// Seven wrong frames more than one in 16 ms.
inline constexpr std::uint32_t operator_error_ticks = 16;
inline constexpr std::uint32_t operator_error_limit = 7 * operator_error_ticks;

// Whole words: it is part of the sealed state (seal.hpp).
class Vigilance {
 public:
  // Once a tick, with the time since the last: ages everything. `driving`: a torque was commanded.
  void begin_tick(std::uint32_t tick, std::uint32_t elapsed, bool active, bool driving,
                  const Percepts& percepts) {
    vision_.expire(tick, vision_timeout_ticks);
    stop_ticks_ = percepts.emergency_stop ? 1 + stop_hold_ticks : rest(stop_ticks_, elapsed);
    if (percepts.wheels) {
      wheels_.feed(tick - percepts.wheels_age_ticks);
    }
    wheels_.expire(tick, wheel_timeout_ticks);
    events_ = 0;
    watch_messages(elapsed, percepts);
    armed_ticks_ = active && !percepts.requests.renew ? aged(armed_ticks_, elapsed) : 0;
    const bool cut = percepts.wheels ? percepts.drives_cut : cut_ticks_ != 0;
    cut_ticks_ = active && driving && cut ? aged(cut_ticks_, elapsed) : 0;
  }

  void see_picture(PictureResult result, std::uint32_t picture_tick, std::uint32_t tick) {
    if (result == PictureResult::implausible) {
      vision_was_implausible_ = 1;
    } else if (result != PictureResult::none) {
      vision_.feed(picture_tick);
      vision_.expire(tick, vision_timeout_ticks);
      vision_was_implausible_ = 0;
      vision_was_invalid_ = 0;
      if (result != PictureResult::between) {
        mismatches_ = result == PictureResult::mismatched ? mismatches_ + 1 : 0;
      }
    }
  }
  void forget_pictures() {
    vision_.forget();
    vision_was_implausible_ = 0;
    mismatches_ = 0;
  }
  void see_impossible_wheels() { events_ |= set_of(Fault::wheels_implausible); }

  [[nodiscard]] bool vision_is_fresh() const { return vision_.ever(); }
  [[nodiscard]] bool wheels_are_fresh() const { return wheels_.ever(); }
  [[nodiscard]] bool stop_is_pressed() const { return stop_ticks_ != 0; }

  [[nodiscard]] Faults causes(bool active) const {
    Faults causes = set_if(!wheels_.ever() && wheels_were_invalid_ != 0, Fault::wheel_state_invalid) |
                    set_if(!vision_.ever() && vision_was_invalid_ != 0, Fault::vision_invalid) |
                    set_if(operator_errors_ > operator_error_limit, Fault::operator_invalid) |
                    set_if(second_controller_ticks_ != 0, Fault::second_controller);
    if (active) {
      causes |= events_ | set_if(armed_ticks_ > armed_limit_ticks, Fault::dead_man) |
                set_if(cut_ticks_ > drives_cut_limit_ticks, Fault::drives_cut) |
                set_if(mismatches_ >= mismatch_limit, Fault::motion_mismatch) |
                set_if(!vision_.ever() && vision_was_implausible_ != 0, Fault::vision_implausible);
    }
    return causes;
  }

 private:
  static constexpr std::uint32_t aged(std::uint32_t ticks, std::uint32_t elapsed) {
    return std::min(ticks + elapsed, 2 * armed_limit_ticks);
  }
  static constexpr std::uint32_t rest(std::uint32_t ticks, std::uint32_t elapsed) {
    return ticks - std::min(ticks, elapsed);
  }

  void watch_messages(std::uint32_t elapsed, const Percepts& percepts) {
    wheels_were_invalid_ = !percepts.wheels && (percepts.invalid.wheels || wheels_were_invalid_ != 0) ? 1 : 0;
    vision_was_invalid_ = percepts.invalid.vision || vision_was_invalid_ != 0 ? 1 : 0;
    operator_errors_ = rest(operator_errors_, elapsed);
    if (percepts.invalid.operators) {
      operator_errors_ = std::min(operator_errors_ + operator_error_ticks, 2 * operator_error_limit);
    }
    second_controller_ticks_ =
        percepts.second_controller ? second_controller_hold_ticks : rest(second_controller_ticks_, elapsed);
  }

  Freshness vision_;  // complete pictures
  Freshness wheels_;
  Faults events_ = 0;                      // of this tick
  std::uint32_t wheels_were_invalid_ = 0;  // since the last one that was taken
  std::uint32_t vision_was_invalid_ = 0;
  std::uint32_t vision_was_implausible_ = 0;
  std::uint32_t mismatches_ = 0;  // in a row
  std::uint32_t operator_errors_ = 0;
  std::uint32_t stop_ticks_ = 0;  // of its hold that are left: a clock that goes back does not shorten it
  std::uint32_t second_controller_ticks_ = 0;
  std::uint32_t armed_ticks_ = 0;
  std::uint32_t cut_ticks_ = 0;
};

}  // namespace striker::core

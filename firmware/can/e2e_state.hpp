// SPDX-License-Identifier: Apache-2.0
// Whether a protected message as a whole can be believed, from the checks of its last frames: AUTOSAR's E2E
// state machine (AUTOSAR_SWS_E2ELibrary, "E2E State Machine") over a window of counts.
//
//   no_data   no frame with a correct CRC since power-on
//   init      the first correct frames have come, or the first after a silence: not yet enough of them
//   valid     believed: at least `least_correct` of the last `counts` counts came, correct and in order
//   invalid   was valid; too many were lost, repeated, out of order or wrong
//
// The window holds a bit a count: each correct frame shifts it by the counter's advance and sets the newest bit,
// so that a lost frame leaves a zero. A wrong frame and one that came twice, bit for bit, shift in a zero each. A counter
// that leaps further than the window forgives, or that comes again with other data, is of a second sender, or a recording
// beside the sender: a contradiction, which empties the window, and only `steps_alone` correct steps without another one
// bring belief back. Frames are taken in the state valid alone, and not right after a gap of more than
// `greatest_step`: a message that comes back is believed after `least_correct` steps, not after one, and a foreign frame
// ahead of the sender's counter is found out by the sender's next.
//
// What follows for old frames: a set of fewer than `least_correct` of them, repeated for ever in any order and at
// any rate, has fewer than `least_correct` distinct counters and is never valid for longer than the window. Beside the
// sender's own frames one of them is taken only just before the sender's next, which contradicts it: its data stands for
// one of the sender's periods, and then not again for `steps_alone` of them. A recording of a whole run of the counter looks like the sender itself: that is authentication's business.
//
// At power-on the window begins with as many ones as leave `least_first` correct steps to go: nothing is armed then. Drives
// do not know that, and take all the steps.
#pragma once

#include <cstdint>

#include "firmware/can/e2e.hpp"

namespace striker::can {

enum class E2eState : std::uint8_t { no_data, init, valid, invalid };

struct E2eWindow {
  std::uint8_t counts;         // at most 16
  std::uint8_t least_correct;  // of them
  std::uint8_t least_first;    // correct steps after the first frame since power-on
  std::uint8_t greatest_step;  // of the counter, for data that is taken
  std::uint8_t steps_alone;    // correct steps after a contradiction
};

// 1 to 10 ms messages: a quarter may be lost, 12 ms of a 1 ms message bring it back. What comes after a gap can wait for the
// next.
inline constexpr E2eWindow fast_window = {
    .counts = 16, .least_correct = 12, .least_first = 3, .greatest_step = 1, .steps_alone = 12};
// Of commands, as drives see them: what an old one does beside a controller that says 0 is to be nothing, on the average.
inline constexpr E2eWindow command_window = {
    .counts = 16, .least_correct = 12, .least_first = 12, .greatest_step = 1, .steps_alone = 100};
// Pictures and orders, 50 ms apart: a sender that was missed once or twice is not to be missed once more.
inline constexpr E2eWindow slow_window = {
    .counts = 8, .least_correct = 6, .least_first = 2, .greatest_step = 3, .steps_alone = 6};

constexpr E2eWindow window_for(std::uint32_t period_ms) {
  return period_ms <= 10 ? fast_window : slow_window;
}

constexpr bool is_sound(const E2eWindow& window) {
  return window.counts <= counter_modulus && window.least_first >= 1 &&
         window.least_first <= window.least_correct && window.least_correct <= window.counts &&
         window.least_correct <= window.steps_alone;
}

// Of whatever window, so that an image holds it once.
class E2eSequence {
 public:
  // `differs()` is asked only of a counter that comes again.
  template <class Differs>
  bool take_correct(const E2eWindow& limits, std::uint8_t counter, const Differs& differs) {
    if (state_ == E2eState::no_data) {
      state_ = E2eState::init;
      last_ = counter;
      follows_ = true;
      window_ = (1U << (limits.least_correct - limits.least_first)) - 1U;
      return false;
    }
    const std::uint32_t advance = follows_ ? (counter - last_) & (counter_modulus - 1U) : 1;
    // After a full window this step leaves just enough.
    const std::uint32_t forgiven_step = limits.counts - limits.least_correct + 1U;
    last_ = counter;
    follows_ = true;
    if (advance == 0 ? differs() : advance > forgiven_step) {
      window_ = 0;
      suspect_steps_ = limits.steps_alone;
    } else {
      window_ = advance == 0 ? window_ << 1U : window_ << advance | 1U;
      suspect_steps_ -= advance != 0 && suspect_steps_ != 0 ? 1U : 0U;
    }
    judge(limits);
    return advance >= 1 && advance <= limits.greatest_step && state_ == E2eState::valid;
  }

  [[gnu::noinline]] void take_wrong(const E2eWindow& limits) {
    window_ <<= 1U;
    judge(limits);
  }

  // Rare, and apart: how often a step comes here at most bounds it (tools/step_bound/facts.toml).
  [[gnu::noinline]] void forget() {
    window_ = 0;
    follows_ = false;
    state_ = state_ == E2eState::no_data ? E2eState::no_data : E2eState::init;
  }

  [[nodiscard]] E2eState state() const { return state_; }

 private:
  void judge(const E2eWindow& limits) {
    window_ &= (1U << limits.counts) - 1U;
    const bool enough = suspect_steps_ == 0 && ones(window_) >= limits.least_correct;
    if (enough && state_ != E2eState::no_data) {
      state_ = E2eState::valid;
    } else if (state_ == E2eState::valid) {
      state_ = E2eState::invalid;
    }
  }

  // Of 16 bits, without a table or a library call, as small cores have no instruction for it.
  static constexpr std::uint32_t ones(std::uint32_t bits) {
    bits -= bits >> 1U & 0x5555U;
    bits = (bits & 0x3333U) + (bits >> 2U & 0x3333U);
    bits = (bits + (bits >> 4U)) & 0x0F0FU;
    return (bits + (bits >> 8U)) & 0x1FU;
  }

  std::uint32_t window_ = 0;
  std::uint32_t suspect_steps_ = 0;  // to go since a contradiction
  std::uint8_t last_ = 0;
  bool follows_ = false;  // there is a last one to compare with: none from before a silence
  E2eState state_ = E2eState::no_data;
};

template <E2eWindow limits>
class E2eMachine {
 public:
  // A frame whose CRC is correct; `differs`, from the last one in any bit. True if its data may be taken.
  bool take_correct(std::uint8_t counter, bool differs) {
    return sequence_.take_correct(window, counter, [differs] { return differs; });
  }
  void take_wrong() { sequence_.take_wrong(window); }

  // Nothing came within the message's time-out: what comes next has to earn its belief anew.
  void forget() { sequence_.forget(); }

  [[nodiscard]] E2eState state() const { return sequence_.state(); }

 private:
  static_assert(is_sound(limits));
  static constexpr E2eWindow window = limits;

  E2eSequence sequence_;
};

}  // namespace striker::can

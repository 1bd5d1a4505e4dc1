// SPDX-License-Identifier: Apache-2.0
// One protected message as its receiver knows it: frames are checked one by one (codec.hpp) and as a sequence
// (e2e_state.hpp), by the time at which they were received.
//
//   MessageReceiver<WheelState> receiver;
//   WheelState state;
//   if (receiver.take(frame, tick, state) == Verdict::accepted) ...   // all of it was replaced, or none
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/e2e_state.hpp"
#include "firmware/core/freshness.hpp"

namespace striker::can {

// What frames are to each other, whatever they say. Several messages of one sender may be one sequence, with one
// counter.
class FrameSequence {
 public:
  struct Rules {
    E2eWindow window;
    std::uint32_t timeout_ticks;
  };

  // `found` is what the frame is by itself; `tick` is now, and it came `frame.age_ms` earlier.
  [[nodiscard, gnu::noinline]] Verdict take(const Rules& rules, const Frame& frame, std::uint32_t tick,
                                            Verdict found) {
    const std::uint32_t received_tick = tick - frame.age_ms;
    // A frame may be older than the last one by the ages that a frame can have: that is no silence.
    const std::uint32_t since_last = received_tick - heard_.tick();
    if (heard_.ever() && since_last > rules.timeout_ticks && since_last < 0U - greatest_age_ticks) {
      machine_.forget();
    }
    heard_.feed(received_tick);
    if (found != Verdict::accepted) {
      machine_.take_wrong(rules.window);
      return found;
    }
    const std::array<std::uint32_t, 2> data = {word<0>(frame), word<1>(frame)};
    const std::uint16_t before_id = std::exchange(last_id_, frame.id);
    const std::array<std::uint32_t, 2> before = std::exchange(last_data_, data);
    const bool taken = machine_.take_correct(rules.window, counter_of(frame), [&] {
      return frame.id != before_id || data[0] != before[0] || data[1] != before[1];
    });
    return taken ? Verdict::accepted : Verdict::wrong_counter;
  }

  // Frames come, and are not to be believed any more.
  [[nodiscard]] bool invalid() const { return machine_.state() == E2eState::invalid; }

 private:
  static constexpr std::uint32_t greatest_age_ticks = 255;

  // memcmp goes byte by byte, and takes half as long as all the rest.
  template <std::size_t i>
  static std::uint32_t word(const Frame& frame) {
    std::uint32_t word = 0;
    __builtin_memcpy(&word, __builtin_assume_aligned(&frame.data[sizeof word * i], sizeof word), sizeof word);
    return word;
  }

  E2eSequence machine_;
  core::Freshness heard_;
  // Of the last frame with a correct CRC.
  std::uint16_t last_id_ = 0;
  std::array<std::uint32_t, 2> last_data_{};
};

template <class Message, E2eWindow window = window_for(layout<Message>.info.period_ms)>
class MessageReceiver {
 public:
  // `tick` is now; the frame came `frame.age_ms` earlier. Accepted, all of `message` is replaced.
  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, Message& message) {
    Message taken;
    const Verdict verdict = sequence_.take(rules, frame, tick, receive(frame, taken));
    if (verdict == Verdict::accepted) {
      message = taken;
    }
    return verdict;
  }

  [[nodiscard]] bool invalid() const { return sequence_.invalid(); }

 private:
  static constexpr FrameSequence::Rules rules = {.window = window,
                                                 .timeout_ticks = layout<Message>.info.timeout_ms};
  static_assert(is_sound(window));
  static_assert(rules.timeout_ticks > 0, "a message on events has no sequence to check");

  FrameSequence sequence_;
};

}  // namespace striker::can

// SPDX-License-Identifier: Apache-2.0
// One protected message as its receiver knows it: frames are checked one by one (codec.hpp) and as a sequence
// (e2e_state.hpp), by the time at which they were received.
//
//   MessageReceiver<WheelState> receiver;
//   WheelState state;
//   if (receiver.take(frame, tick, state) == Verdict::accepted) ...   // all of it was replaced, or none
#pragma once

#include <cstdint>

#include "firmware/can/codec.hpp"
#include "firmware/can/e2e_state.hpp"
#include "firmware/core/freshness.hpp"

namespace striker::can {

template <class Message, E2eWindow window = window_for(layout<Message>.info.period_ms)>
class MessageReceiver {
 public:
  // `tick` is now; the frame came `frame.age_ms` earlier. Accepted, all of `message` is replaced.
  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, Message& message) {
    const std::uint32_t received_tick = tick - frame.age_ms;
    // A frame may be older than the last one by the ages that a frame can have: that is no silence.
    const std::uint32_t since_last = received_tick - heard_.tick();
    if (heard_.ever() && since_last > timeout_ticks && since_last < 0U - greatest_age_ticks) {
      machine_.forget();
    }
    Message taken;
    const Verdict verdict = receive(frame, taken);
    heard_.feed(received_tick);
    if (verdict != Verdict::accepted) {
      machine_.take_wrong();
      return verdict;
    }
    const bool differs = frame.data != last_data_;
    last_data_ = frame.data;
    if (!machine_.take_correct(counter_of(frame), differs)) {
      return Verdict::wrong_counter;
    }
    message = taken;
    return Verdict::accepted;
  }

  // Frames come, and are not to be believed any more.
  [[nodiscard]] bool invalid() const { return machine_.state() == E2eState::invalid; }

 private:
  static constexpr const MessageInfo& info = layout<Message>.info;
  static constexpr std::uint32_t timeout_ticks = info.timeout_ms;
  static constexpr std::uint32_t greatest_age_ticks = 255;
  static_assert(timeout_ticks > 0, "a message on events has no sequence to check");

  E2eMachine<window> machine_;
  core::Freshness heard_;
  decltype(Frame::data) last_data_{};  // of a frame with a correct CRC
};

}  // namespace striker::can

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

template <class Message>
class MessageReceiver {
 public:
  // `tick` is now; the frame came `frame.age_ms` earlier. Accepted, all of `message` is replaced.
  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, Message& message) {
    const std::uint32_t received_tick = tick - frame.age_ms;
    if (heard_.ever() && static_cast<std::int32_t>(received_tick - heard_.tick()) > timeout_ticks) {
      machine_.forget();
    }
    Message taken;
    const Verdict verdict = receive(frame, taken);
    heard_.feed(received_tick);
    if (verdict != Verdict::accepted) {
      machine_.take_wrong();
      return verdict;
    }
    if (!machine_.take_correct(counter_of(frame))) {
      return Verdict::wrong_counter;
    }
    message = taken;
    return Verdict::accepted;
  }

  // Frames come, and are not to be believed any more.
  [[nodiscard]] bool invalid() const { return machine_.state() == E2eState::invalid; }

 private:
  static constexpr const MessageInfo& info = layout<Message>.info;
  static constexpr std::int32_t timeout_ticks = info.timeout_ms;
  static_assert(timeout_ticks > 0, "a message on events has no sequence to check");

  E2eMachine<window_for(info.period_ms)> machine_;
  core::Freshness heard_;
};

}  // namespace striker::can

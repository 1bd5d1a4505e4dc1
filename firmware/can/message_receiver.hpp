// SPDX-License-Identifier: Apache-2.0
// One protected message as a receiver knows it: its counter, and how long that is remembered.
#pragma once

#include <cstdint>

#include "firmware/can/codec.hpp"
#include "firmware/core/freshness.hpp"

namespace striker::can {

// A message without a time-out of its own is an operator's: this long after the last one its counter is
// forgotten, so that another tool may start anywhere.
inline constexpr std::uint32_t event_counter_memory_ticks = 200;

template <class Message>
class MessageReceiver {
 public:
  // Checks the frame; accepted, all of `message` is replaced, otherwise none of it.
  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, Message& message) {
    constexpr std::uint32_t timeout_ms = layout<Message>.info.timeout_ms;
    constexpr std::uint32_t memory_ticks = timeout_ms != 0 ? timeout_ms : event_counter_memory_ticks;
    counter_.seen = counter_.seen && accepted_.within(tick, memory_ticks);
    const Verdict verdict = receive(frame, counter_, message);
    if (verdict == Verdict::accepted) {
      accepted_.feed(tick);
    }
    return verdict;
  }

 private:
  ReceiveCounter counter_;
  core::Freshness accepted_;
};

}  // namespace striker::can

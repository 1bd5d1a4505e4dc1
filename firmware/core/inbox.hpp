// The controller's receive side: every frame is checked, then taken whole or ignored whole and counted.
// Freshness is fed by accepted messages only.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/can/codec.hpp"
#include "firmware/core/estimator.hpp"

namespace striker::core {

// A stop frame holds this long, so that a clear cannot overtake a pressed button that repeats it; and this
// long after the last one, the counter of a message without a period is forgotten, so that another operator's
// tool may start anywhere.
inline constexpr std::uint32_t event_memory_ticks = 200;

// When something last happened, and whether that is recent enough.
struct Freshness {
  bool ever = false;
  std::uint32_t tick = 0;

  void feed(std::uint32_t now) { *this = {true, now}; }
  [[nodiscard]] bool within(std::uint32_t now, std::uint32_t limit_ticks) const {
    return ever && now - tick <= limit_ticks;
  }
};

// Frames ignored since boot, by reason. Each stays at 255.
struct IgnoredFrames {
  std::int32_t wrong_length = 0;
  std::int32_t wrong_crc = 0;
  std::int32_t wrong_counter = 0;
  std::int32_t out_of_range = 0;
};

struct Requests {
  bool arm = false;
  bool disarm = false;
  bool clear = false;
};

class Inbox {
 public:
  // Checks this tick's frames, in their order, and hands vision and wheel states to the estimator; a disarm
  // resets it, so that only pictures after the disarm count. Other identifiers are none of its business.
  Requests take(std::span<const can::Frame> frames, std::uint32_t tick, Estimator& estimator);

  [[nodiscard]] bool emergency_stop(std::uint32_t tick) const {
    return stop_.accepted.within(tick, event_memory_ticks);
  }
  [[nodiscard]] bool wheels_fresh(std::uint32_t tick) const {
    return wheels_.accepted.within(tick, can::layout<can::WheelState>.info.timeout_ms);
  }
  [[nodiscard]] const can::WheelState& wheels() const { return wheel_state_; }
  [[nodiscard]] const IgnoredFrames& ignored() const { return ignored_; }

 private:
  // One message's receive state.
  struct Receiver {
    can::ReceiveCounter counter;
    Freshness accepted;
  };

  template <class Message>
  bool accept(const can::Frame& frame, std::uint32_t tick, Receiver& receiver, Message& message);
  void take_mode(const can::Frame& frame, std::uint32_t tick, Estimator& estimator, Requests& requests);
  void count(can::Verdict verdict);

  Receiver stop_;
  Receiver mode_;
  Receiver wheels_;
  Receiver pose_;
  Receiver ball_;
  can::WheelState wheel_state_;
  IgnoredFrames ignored_;
};

}  // namespace striker::core

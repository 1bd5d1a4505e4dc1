// Lockstep: a controller whose ticks are the bus's SYNC frames. Frames are kept until a valid SYNC(t) ends
// the tick; then the controller steps once, at t. SYNC(0) starts logical time anew, with a controller fresh
// from boot, so that one firmware process serves one simulation after another with the same answers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/controller.hpp"

namespace striker::core {

class SyncClock {
 public:
  // True if the frame was a SYNC that ended a tick: then `outputs` holds the answer.
  bool take(const can::Frame& frame, Outputs& outputs);

  [[nodiscard]] Controller& controller() { return controller_; }
  [[nodiscard]] const Controller& controller() const { return controller_; }
  [[nodiscard]] bool running() const { return counter_.seen; }

 private:
  // More than any tick brings; beyond it frames are dropped, and the receive checks notice the gap.
  static constexpr std::size_t capacity = 32;

  Controller controller_;
  can::ReceiveCounter counter_;
  std::uint32_t tick_ = 0;
  std::array<can::Frame, capacity> waiting_{};
  std::size_t count_ = 0;
};

}  // namespace striker::core

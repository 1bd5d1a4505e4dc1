// SPDX-License-Identifier: Apache-2.0
// The board's CAN controller as the loop's bus: polled while the loop waits for its tick.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/loop/bus.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"
#include "firmware/ports/bare_metal/can_bus.hpp"

namespace striker::bare_metal {

// More than 1 ms of a 1 Mbit/s bus holds (21 of the shortest frames).
inline constexpr std::size_t most_frames_a_tick = 24;

class BoardBus {
 public:
  explicit constexpr BoardBus(const BoardClock& clock) : clock_(&clock) {}

  // What finds no room is dropped; the receive checks see the gap.
  void poll() {
    if (handed_out_) {
      handed_out_ = false;
      count_ = 0;
    }
    can::Frame frame;
    if (receive_can(frame) && count_ < frames_.size()) {
      oldest_us_ = count_ == 0 ? clock_->now() : oldest_us_;
      frames_[count_++] = frame;
    }
  }

  loop::Received<BoardClock::Time> receive(std::size_t most) {
    const std::size_t count = handed_out_ ? 0 : std::min(most, count_);
    handed_out_ = true;
    return {.frames = std::span(frames_).first(count), .oldest = oldest_us_};
  }

  std::size_t try_send(std::span<const can::Frame> frames) {
    std::size_t taken = 0;
    for (const can::Frame& frame : frames) {
      taken += try_send_can(frame) ? 1 : 0;
    }
    return taken;
  }

  [[nodiscard]] can::BusHealth health() const { return can_health(); }

 private:
  const BoardClock* clock_;
  bool handed_out_ = false;  // the frames are the loop's until the next poll
  std::array<can::Frame, most_frames_a_tick> frames_{};
  std::size_t count_ = 0;
  BoardClock::Time oldest_us_ = 0;
};

static_assert(loop::Bus<BoardBus, BoardClock::Time>);

}  // namespace striker::bare_metal

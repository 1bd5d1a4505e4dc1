// SPDX-License-Identifier: Apache-2.0
// The board's CAN controller as the loop's bus: polled while the loop waits for its tick.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/ports/bare_metal/board_clock.hpp"
#include "firmware/ports/bare_metal/can_bus.hpp"

namespace striker::bare_metal {

// More than 1 ms of a 1 Mbit/s bus holds (21 of the shortest frames).
inline constexpr std::size_t most_frames_a_tick = 24;

class BoardBus {
 public:
  explicit constexpr BoardBus(const BoardClock& clock) : clock_(&clock) {}

  // What finds no room is dropped and counted. After a pause what waits in the controller is as old as the pause, for
  // all that anybody knows: until it has been emptied.
  void poll() {
    if (handed_out_) {
      handed_out_ = false;
      count_ = 0;
    }
    const BoardClock::Time now_us = clock_->now();
    const auto pause_us = static_cast<std::uint32_t>(now_us) - static_cast<std::uint32_t>(polled_us_);
    polled_us_ = now_us;
    if (pause_us > longest_step_us) {
      backlog_age_ms_ = static_cast<std::uint8_t>(std::min<std::uint32_t>(pause_us / 1'000U, 255));
    }
    can::Frame frame;
    if (!receive_can(frame)) {
      backlog_age_ms_ = 0;
      return;
    }
    frame.age_ms = backlog_age_ms_;
    keep(frame);
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
  [[nodiscard]] std::uint32_t lost() { return std::exchange(lost_, 0); }

 private:
  // Between two polls there is at most a step.
  static constexpr std::uint32_t longest_step_us = 2'000;

  // An emergency stop always finds room, and a wrong frame on its identifier takes none of it.
  void keep(const can::Frame& frame) {
    if (count_ < frames_.size()) {
      oldest_us_ = count_ == 0 ? clock_->now() : oldest_us_;
      frames_[count_++] = frame;
      return;
    }
    ++lost_;
    if (can::is_valid<can::EmergencyStop>(frame)) {
      frames_.back() = frame;
    }
  }

  const BoardClock* clock_;
  bool handed_out_ = false;  // the frames are the loop's until the next poll
  std::array<can::Frame, most_frames_a_tick> frames_{};
  std::size_t count_ = 0;
  BoardClock::Time oldest_us_ = 0;
  BoardClock::Time polled_us_ = 0;
  std::uint32_t lost_ = 0;
  std::uint8_t backlog_age_ms_ = 0;
};

static_assert(loop::Bus<BoardBus, BoardClock::Time>);

}  // namespace striker::bare_metal

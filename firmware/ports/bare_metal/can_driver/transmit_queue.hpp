// SPDX-License-Identifier: Apache-2.0
// Frames that wait for a CAN controller's transmit buffers, as can_bus.hpp wants them: the lowest identifier first,
// frames of one identifier in the order of the calls, and none older than 10 ms.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/frame.hpp"

namespace striker::bare_metal {

// The wheel command's time-out: after it the drives have cut the torque, and what comes then is too late.
inline constexpr std::uint32_t transmit_timeout_ticks = 10;

class TransmitQueue {
 public:
  // What a tick makes at most (9), and some that still wait.
  static constexpr std::size_t capacity = 12;

  // False if there is no room.
  bool add(const can::Frame& frame, std::uint32_t tick) {
    if (count_ == capacity) {
      return false;
    }
    const auto waiting = std::span(entries_).first(count_);
    auto at = count_;
    while (at > 0 && frame.id < waiting[at - 1].frame.id) {
      entries_[at] = entries_[at - 1];
      --at;
    }
    entries_[at] = {.frame = frame, .since = tick};
    ++count_;
    return true;
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  // The next to go, and since when it waits. Not of an empty queue.
  [[nodiscard]] const can::Frame& front() const { return entries_[0].frame; }
  [[nodiscard]] std::uint32_t front_since() const { return entries_[0].since; }
  void pop() {
    --count_;
    std::copy_n(entries_.begin() + 1, count_, entries_.begin());
  }

  // How many went.
  std::size_t drop_too_old(std::uint32_t tick) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (tick - entries_[i].since < transmit_timeout_ticks) {
        entries_[kept++] = entries_[i];
      }
    }
    const std::size_t dropped = count_ - kept;
    count_ = kept;
    return dropped;
  }

  std::size_t clear() {
    const std::size_t dropped = count_;
    count_ = 0;
    return dropped;
  }

 private:
  struct Entry {
    can::Frame frame;
    std::uint32_t since = 0;
  };

  std::array<Entry, capacity> entries_{};
  std::size_t count_ = 0;
};

}  // namespace striker::bare_metal

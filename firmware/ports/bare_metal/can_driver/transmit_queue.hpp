// SPDX-License-Identifier: Apache-2.0
// Frames that wait for a CAN controller's transmit buffers, as can_bus.hpp wants them: the lowest identifier first,
// frames of one identifier in the order of the calls, and none older than 10 ms. Of fixed size: a full queue takes a more
// urgent frame in the place of the least urgent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/can/frame.hpp"

namespace striker::bare_metal {

// The wheel command's time-out: after it the drives have cut the torque, and what comes then is too late.
inline constexpr std::uint32_t transmit_timeout_ticks = 10;

struct Waiting {
  can::Frame frame;
  std::uint32_t since_tick = 0;

  [[nodiscard]] bool is_too_old(std::uint32_t tick) const {
    return tick - since_tick >= transmit_timeout_ticks;
  }
};

class TransmitQueue {
 public:
  // A tick's nine frames, and what a bus that is not acknowledged leaves of a command every 1 ms and a status every 10.
  static constexpr std::size_t capacity = 16;

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  // In the order in which they are to go.
  [[nodiscard]] const Waiting& operator[](std::size_t at) const { return entries_[at]; }

  // False if it is full of frames at least as urgent.
  bool add(const Waiting& waiting) {
    return insert(waiting, [&](const can::Frame& other) { return other.id <= waiting.frame.id; });
  }
  // One that had its turn before, and was taken back: before the others of its identifier.
  bool put_back(const Waiting& waiting) {
    return insert(waiting, [&](const can::Frame& other) { return other.id < waiting.frame.id; });
  }

  // Apart: how often a driver takes a frame out bounds it (tools/step_bound/facts.toml).
  [[gnu::noinline]] void remove(std::size_t at) {
    for (--count_; at < count_; ++at) {
      entries_[at] = entries_[at + 1];
    }
  }

  // How many went.
  std::size_t drop_too_old(std::uint32_t tick) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!entries_[i].is_too_old(tick)) {
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
  template <class GoesFirst>
  bool insert(const Waiting& waiting, GoesFirst goes_first) {
    std::size_t at = 0;
    while (at < count_ && goes_first(entries_[at].frame)) {
      ++at;
    }
    if (at == capacity) {
      return false;
    }
    count_ += count_ < capacity ? 1 : 0;
    for (std::size_t to = count_ - 1; to > at; --to) {
      entries_[to] = entries_[to - 1];
    }
    entries_[at] = waiting;
    return true;
  }

  std::array<Waiting, capacity> entries_{};
  std::size_t count_ = 0;
};

}  // namespace striker::bare_metal

// SPDX-License-Identifier: Apache-2.0
// Frames that wait for one of a controller's mailboxes: the lowest identifier first, and those of one identifier in their
// order. Of fixed size; a full queue takes a more urgent frame in the place of the least urgent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/ports/bare_metal/can_bus.hpp"

namespace striker::stm32f4 {

struct Waiting {
  can::Frame frame;
  std::uint32_t since_ms = 0;
};

class TransmitQueue {
 public:
  // A tick's nine frames, and what a bus that is not acknowledged leaves of a command every 1 ms and a status every 10.
  static constexpr std::size_t capacity = 16;

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const Waiting& operator[](std::size_t at) const { return entries_[at]; }

  // False if it is full of frames at least as urgent.
  bool add(const Waiting& waiting) {
    return insert(waiting, [&](const can::Frame& other) { return other.id <= waiting.frame.id; });
  }
  // One that had its turn before, and was taken back: before the others of its identifier.
  bool put_back(const Waiting& waiting) {
    return insert(waiting, [&](const can::Frame& other) { return other.id < waiting.frame.id; });
  }

  void remove(std::size_t at) {
    for (--count_; at < count_; ++at) {
      entries_[at] = entries_[at + 1];
    }
  }
  void clear() { count_ = 0; }

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

}  // namespace striker::stm32f4

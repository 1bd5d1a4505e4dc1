// SPDX-License-Identifier: Apache-2.0
// The frames of one step, in the order of sending.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/can/frame.hpp"

namespace striker::can {

class FrameList {
 public:
  // Whoever adds states at compile time how much that is at most (see reporter.hpp): a frame beyond it would
  // be dropped.
  static constexpr std::size_t capacity = 12;

  void clear() { count_ = 0; }
  void add(const Frame& frame) {
    if (count_ < capacity) {
      frames_[count_++] = frame;
    }
  }
  // Drops the frames that `may_stay` refuses; returns how many.
  template <class Predicate>
  std::size_t keep(Predicate may_stay) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (may_stay(frames_[i])) {
        frames_[kept++] = frames_[i];
      }
    }
    const std::size_t dropped = count_ - kept;
    count_ = kept;
    return dropped;
  }
  [[nodiscard]] std::span<Frame> frames() { return std::span(frames_).first(count_); }
  [[nodiscard]] std::span<const Frame> frames() const { return std::span(frames_).first(count_); }

 private:
  std::array<Frame, capacity> frames_{};
  std::size_t count_ = 0;
};

}  // namespace striker::can

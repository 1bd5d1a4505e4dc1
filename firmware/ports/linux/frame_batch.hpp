// SPDX-License-Identifier: Apache-2.0
// The frames that a bus of this port has received for one tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/frame.hpp"
#include "firmware/loop/bus.hpp"

namespace striker::linux_port {

// As many as a tick may be told to receive.
inline constexpr std::uint32_t greatest_frames_per_tick = 256;

class FrameBatch {
 public:
  void clear() { count_ = 0; }
  // `received_ns` by the loop's clock.
  void add(const can::Frame& frame, std::int64_t received_ns) {
    oldest_ns_ = count_ == 0 ? received_ns : oldest_ns_;
    frames_[count_++] = frame;
  }
  [[nodiscard]] loop::Received<std::int64_t> received() const {
    return {.frames = std::span(frames_).first(count_), .oldest = oldest_ns_};
  }

 private:
  std::array<can::Frame, greatest_frames_per_tick> frames_{};
  std::size_t count_ = 0;
  std::int64_t oldest_ns_ = 0;
};

}  // namespace striker::linux_port

// SPDX-License-Identifier: Apache-2.0
// A bus in memory, of fixed size: one frame in at a time, and what the last step sent. For runs that are repeated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/frame_list.hpp"
#include "firmware/loop/bus.hpp"

namespace striker::loop {

class FrameQueue {
 public:
  void push(const can::Frame& frame) {
    frame_ = frame;
    waits_ = true;
  }
  [[nodiscard]] std::span<const can::Frame> sent() const { return sent_.frames(); }

  void poll() {}
  Received<std::int64_t> receive(std::size_t) {
    const std::size_t count = waits_ ? 1 : 0;
    waits_ = false;
    return {.frames = std::span(&frame_, count)};
  }
  std::size_t try_send(std::span<const can::Frame> frames) {
    sent_.clear();
    for (const can::Frame& frame : frames) {
      sent_.add(frame);
    }
    return frames.size();
  }
  [[nodiscard]] can::BusHealth health() const { return can::BusHealth::active; }
  [[nodiscard]] std::uint32_t lost() const { return 0; }

 private:
  can::Frame frame_;
  bool waits_ = false;
  can::FrameList sent_;
};

static_assert(Bus<FrameQueue, std::int64_t>);

}  // namespace striker::loop

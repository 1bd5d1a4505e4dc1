// SPDX-License-Identifier: Apache-2.0
// A bus between two threads of one process, for real-time runs without CAN: a ring of frames each way, one
// writer and one reader each, without locks. A full ring drops the frame, as a full socket does.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <optional>

#include "firmware/host/can/can_socket.hpp"
#include "firmware/host/periodic_clock.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/ports/linux/frame_batch.hpp"

namespace striker::linux_port {

struct StampedFrame {
  can::Frame frame;
  std::int64_t received_ns = 0;  // CLOCK_MONOTONIC, when the host had it
};

// One thread calls `push`, one calls `pop`.
class FrameRing {
 public:
  bool push(const StampedFrame& frame) {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == frames_.size()) {
      return false;
    }
    frames_[end % frames_.size()] = frame;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  std::optional<StampedFrame> pop() {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) {
      return std::nullopt;
    }
    const StampedFrame frame = frames_[begin % frames_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return frame;
  }

 private:
  std::array<StampedFrame, 1024> frames_{};
  alignas(64) std::atomic<std::size_t> begin_ = 0;
  alignas(64) std::atomic<std::size_t> end_ = 0;
};

// The controller's end is the loop's bus; the other end has functions of its own.
class InProcessBus {
 public:
  // The clock that the frames' times are of.
  explicit InProcessBus(host::AbsoluteClock& clock) : clock_(&clock) {}

  void poll() {}
  std::size_t try_send(std::span<const can::Frame> frames) {
    std::size_t taken = 0;
    for (const can::Frame& frame : frames) {
      taken += from_controller_.push({frame, 0}) ? 1 : 0;
    }
    return taken;
  }

  loop::Received<std::int64_t> receive(std::size_t most) {
    batch_.clear();
    const std::int64_t now_ns = clock_->now_ns();
    for (std::size_t i = 0; i < std::min<std::size_t>(most, greatest_frames_per_tick); ++i) {
      auto stamped = to_controller_.pop();
      if (!stamped) {
        break;
      }
      stamped->frame.age_ms = host::age_ms(stamped->received_ns, now_ns);
      batch_.add(stamped->frame, stamped->received_ns);
    }
    return batch_.received();
  }

  [[nodiscard]] can::BusHealth health() const { return can::BusHealth::active; }
  [[nodiscard]] std::uint32_t lost() { return lost_.exchange(0, std::memory_order_relaxed); }

  bool send_to_controller(const can::Frame& frame, std::int64_t now_ns) {
    const bool kept = to_controller_.push({frame, now_ns});
    lost_.fetch_add(kept ? 0 : 1, std::memory_order_relaxed);
    return kept;
  }
  std::optional<can::Frame> receive_from_controller() {
    const auto stamped = from_controller_.pop();
    return stamped ? std::optional(stamped->frame) : std::nullopt;
  }

 private:
  host::AbsoluteClock* clock_;
  FrameRing to_controller_;
  FrameRing from_controller_;
  std::atomic<std::uint32_t> lost_ = 0;
  FrameBatch batch_;
};

static_assert(loop::Bus<InProcessBus, std::int64_t>);

}  // namespace striker::linux_port

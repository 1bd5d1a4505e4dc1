// A bus between two threads of one process, for real-time runs without CAN: a ring of frames each way, one
// writer and one reader each, without locks. A full ring drops the frame, as a full socket does.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>

#include "firmware/ports/linux/frame_bus.hpp"

namespace striker::linux_port {

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

// The controller's end is the FrameBus; the other end has functions of its own.
class InProcessBus final : public FrameBus {
 public:
  std::size_t send(std::span<const can::Frame> frames) override {
    std::size_t dropped = 0;
    for (const can::Frame& frame : frames) {
      dropped += from_controller_.push({frame, 0}) ? 0 : 1;
    }
    return dropped;
  }

  std::size_t receive(std::span<StampedFrame> frames) override {
    std::size_t count = 0;
    while (count < frames.size()) {
      const auto frame = to_controller_.pop();
      if (!frame) {
        break;
      }
      frames[count++] = *frame;
    }
    return count;
  }

  bool take_bus_off() override { return false; }

  bool send_to_controller(const can::Frame& frame, std::int64_t now_ns) {
    return to_controller_.push({frame, now_ns});
  }
  std::optional<can::Frame> receive_from_controller() {
    const auto stamped = from_controller_.pop();
    return stamped ? std::optional(stamped->frame) : std::nullopt;
  }

 private:
  FrameRing to_controller_;
  FrameRing from_controller_;
};

}  // namespace striker::linux_port

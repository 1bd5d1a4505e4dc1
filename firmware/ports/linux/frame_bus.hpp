// The bus as the real-time loop sees it: nothing here blocks or throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/frame.hpp"

namespace striker::linux_port {

// As many as a tick may be told to receive.
inline constexpr std::uint32_t greatest_frames_per_tick = 256;

struct StampedFrame {
  can::Frame frame;
  std::int64_t received_ns = 0;  // CLOCK_MONOTONIC, when the host had it
};

class FrameBus {
 public:
  virtual ~FrameBus() = default;
  // Sends the frames in their order, and returns how many the bus did not take.
  virtual std::size_t send(std::span<const can::Frame> frames) = 0;
  // Fills `frames`, of up to greatest_frames_per_tick, with what waits, the oldest first; returns how many.
  virtual std::size_t receive(std::span<StampedFrame> frames) = 0;
  // True if the bus has gone off since the last call.
  virtual bool take_bus_off() = 0;
};

}  // namespace striker::linux_port

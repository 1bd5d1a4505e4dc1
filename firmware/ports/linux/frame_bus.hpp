// The bus as the real-time loop sees it: neither call blocks.
#pragma once

#include <cstdint>
#include <optional>

#include "can/frame.hpp"

namespace striker::linux_port {

struct StampedFrame {
  can::Frame frame;
  std::int64_t received_ns = 0;  // CLOCK_MONOTONIC, when the host had it
};

class FrameBus {
 public:
  virtual ~FrameBus() = default;
  // False if the frame was dropped.
  virtual bool send(const can::Frame& frame) = 0;
  // The next frame that waits, or nothing.
  virtual std::optional<StampedFrame> receive_stamped() = 0;
  // True if the bus has gone off since the last call.
  virtual bool take_bus_off() = 0;
};

}  // namespace striker::linux_port

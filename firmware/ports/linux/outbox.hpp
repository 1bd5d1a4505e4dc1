// What executors do with the controller's answer: send its frames, and tell a changed fault on stderr.
#pragma once

#include <fmt/core.h>

#include <cstdint>

#include "firmware/core/controller.hpp"
#include "firmware/host/can_socket.hpp"

namespace striker::linux_port {

// The number of frames that the socket did not take.
inline std::uint64_t send_all(host::CanSocket& socket, const core::Outputs& outputs) {
  std::uint64_t dropped = 0;
  for (const can::Frame& frame : outputs.frames()) {
    dropped += socket.send(frame) ? 0 : 1;
  }
  return dropped;
}

class FaultAnnouncer {
 public:
  void announce(can::Fault fault) {
    if (fault == told_) {
      return;
    }
    told_ = fault;
    if (told_ == can::Fault::none) {
      fmt::print(stderr, "striker-firmware: fault cleared\n");
    } else {
      fmt::print(stderr, "striker-firmware: fault {}: torque 0\n",
                 can::name_of(can::fault_names, static_cast<std::int32_t>(told_)));
    }
  }

 private:
  can::Fault told_ = can::Fault::none;
};

}  // namespace striker::linux_port

// SPDX-License-Identifier: Apache-2.0
// Brings a real-time socket back whose interface has gone, and tells both on stderr. For a thread beside the loop.
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

#include "firmware/host/can/back_off.hpp"

namespace striker::host {

// A socket with is_gone() and reopen(), as linux_port::RealTimeSocket.
template <class Socket>
class InterfaceWatch {
 public:
  InterfaceWatch(Socket& socket, std::string interface)
      : socket_(&socket), interface_(std::move(interface)) {}

  // To be called again and again. Even one that is up again by itself takes new sockets: whether it is the same
  // interface is nothing that its name tells.
  void look(BackOff::Time now) {
    if (!socket_->is_gone()) {
      if (std::exchange(told_, false)) {
        fmt::print(stderr, "striker-firmware: CAN interface '{}' is back: clear the fault, then arm\n",
                   interface_);
      }
      back_off_.reset();
      return;
    }
    if (!std::exchange(told_, true)) {
      fmt::print(stderr,
                 "striker-firmware: CAN interface '{}' went away or down: torque 0 until it is there and up "
                 "again ('ip link set up {}')\n",
                 interface_, interface_);
    }
    if (back_off_.due(now)) {
      static_cast<void>(socket_->reopen());
    }
  }

 private:
  Socket* socket_;
  std::string interface_;
  BackOff back_off_;
  bool told_ = false;
};

}  // namespace striker::host

// SPDX-License-Identifier: Apache-2.0
// SocketCAN for the real-time loop: one system call receives all the frames of a tick, with the kernel's time
// stamps, and one sends them. Emergency stops have a socket of their own, which is read first: no other traffic
// stands before them, and no full queue drops them.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <string>

#include "firmware/host/can/can_socket.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/ports/linux/frame_batch.hpp"

namespace striker::linux_port {

class RealTimeSocket {
 public:
  // Throws as host::CanSocket does.
  RealTimeSocket(const std::string& interface, std::span<const std::uint16_t> identifiers);

  void poll() {}

  // A bus that is off, a full queue or an interface that has gone drop frames; the last also counts as a bus
  // that has gone off, until a frame passes again.
  std::size_t try_send(std::span<const can::Frame> frames);

  // The kernel stamps the frames. It does so with the calendar's clock: for about a second after that was
  // set it may be off by as much.
  loop::Received<std::int64_t> receive(std::size_t most);

  [[nodiscard]] can::BusHealth health() { return gone_ ? can::BusHealth::bus_off : socket_.health(); }
  [[nodiscard]] std::uint32_t lost() { return socket_.lost(); }

 private:
  struct Slot {
    can_frame wire;
    iovec part;
    alignas(cmsghdr) std::array<char, host::reception_space> control;
  };

  void read_calendar();

  host::CanSocket socket_;
  host::CanSocket stops_;
  std::array<Slot, greatest_frames_per_tick> slots_{};
  std::array<mmsghdr, greatest_frames_per_tick> messages_{};
  std::int64_t calendar_ns_ = 0;  // CLOCK_REALTIME less CLOCK_MONOTONIC
  std::uint32_t receptions_ = 0;
  FrameBatch batch_;
  bool gone_ = false;
};

static_assert(loop::Bus<RealTimeSocket, std::int64_t>);

}  // namespace striker::linux_port

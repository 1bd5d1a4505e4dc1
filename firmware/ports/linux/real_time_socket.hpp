// SPDX-License-Identifier: Apache-2.0
// SocketCAN for the real-time loop: one system call receives all the frames of a tick, with the kernel's time
// stamps, and one sends them. Emergency stops have a socket of their own, which is read first: no other identifier's
// traffic stands before them, or fills their queue.
//
// An interface that goes down or is deleted is a bus that is off. One that was made anew under the same name, as by a
// USB adapter that was plugged in again, takes new sockets: another thread makes them (`reopen`), as that allocates.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

  // Times are the kernel's stamps. Where the calendar's clock was set meanwhile, they may be off by two ticks
  // (host/can/stamp_clock.hpp).
  loop::Received<std::int64_t> receive(std::size_t most);

  [[nodiscard]] can::BusHealth health() { return is_gone() ? can::BusHealth::bus_off : socket_.health(); }
  [[nodiscard]] std::uint32_t lost() { return socket_.lost() + stops_.lost() + std::exchange(skipped_, 0); }

  // For another thread. `reopen` is false as long as there is no such interface, or it is down; else the loop's next
  // calls go through new sockets.
  [[nodiscard]] bool is_gone() const { return gone_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool reopen();

 private:
  struct Slot {
    can_frame wire;
    iovec part;
    alignas(cmsghdr) std::array<char, host::reception_space> control;
  };

  std::size_t receive_stops(std::size_t room);

  std::string interface_;
  std::vector<std::uint16_t> others_;
  host::CanSocket socket_;
  host::CanSocket stops_;
  std::array<Slot, greatest_frames_per_tick> slots_{};
  std::array<mmsghdr, greatest_frames_per_tick> messages_{};
  host::StampClock stamps_;
  FrameBatch batch_;
  std::uint32_t skipped_ = 0;
  std::atomic<bool> gone_ = false;
};

static_assert(loop::Bus<RealTimeSocket, std::int64_t>);

}  // namespace striker::linux_port

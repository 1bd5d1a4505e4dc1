// A SocketCAN socket for the real-time loop: one system call receives all the frames of a tick, with the
// kernel's time stamps, and one sends them.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <string>

#include "firmware/host/can_socket.hpp"
#include "firmware/ports/linux/frame_bus.hpp"

namespace striker::linux_port {

class RealTimeSocket final : public FrameBus {
 public:
  // Throws as host::CanSocket does.
  RealTimeSocket(const std::string& interface, std::span<const std::uint16_t> identifiers);

  // A bus that is off, a full queue or an interface that has gone drop frames; the last also counts as a bus
  // that has gone off.
  std::size_t send(std::span<const can::Frame> frames) override;

  // Stamps are the kernel's. It stamps with the calendar's clock: for about a second after that was set they
  // may be off by as much.
  std::size_t receive(std::span<StampedFrame> frames) override;

  bool take_bus_off() override;

 private:
  struct Slot {
    can_frame wire;
    iovec part;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control;
  };

  void read_calendar();

  host::CanSocket socket_;
  std::array<Slot, greatest_frames_per_tick> slots_{};
  std::array<mmsghdr, greatest_frames_per_tick> messages_{};
  std::int64_t calendar_ns_ = 0;  // CLOCK_REALTIME less CLOCK_MONOTONIC
  std::uint32_t receptions_ = 0;
  bool gone_ = false;
};

}  // namespace striker::linux_port

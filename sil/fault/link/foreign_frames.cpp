// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/link/foreign_frames.hpp"

#include <fmt/format.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <stdexcept>
#include <system_error>

#include "firmware/host/can/can_socket.hpp"
#include "sil/fault/link/injected_frames.hpp"

namespace striker::sil {

namespace {

constexpr std::uint8_t fd_bytes = 64;

class ForeignFrames final : public FrameFault {
 public:
  ForeignFrames(const TimedFault& fault, const Random& random, const std::string& interface)
      : fault_(fault), frames_(fault.fault, random), interface_(interface), socket_(interface, nobody) {
    const int on = 1;
    setsockopt(socket_.handle(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
  }

  void to_controller(std::uint32_t tick, std::vector<can::Frame>&) override {
    for (std::uint32_t i = 0; fault_.lasts(tick) && i < fault_.fault.count; ++i) {
      send(frames_.draw());
    }
  }

 private:
  // It receives nothing.
  static constexpr std::span<const std::uint16_t> nobody = {};

  void send(const can::Frame& frame) const {
    constexpr std::uint32_t extension_bits = 18;
    can_frame wire = host::to_wire(frame);
    if (fault_.fault.kind == FaultKind::fd_frames) {
      canfd_frame longer{};
      longer.can_id = wire.can_id;
      longer.len = fd_bytes;
      std::copy_n(wire.data, frame.length, longer.data);
      return write_all(&longer, sizeof longer);
    }
    wire.can_id = fault_.fault.kind == FaultKind::remote_frames
                      ? wire.can_id | CAN_RTR_FLAG
                      : wire.can_id << extension_bits | CAN_EFF_FLAG;
    write_all(&wire, sizeof wire);
  }

  // A full queue loses the frame, as on any bus.
  void write_all(const void* frame, std::size_t size) const {
    if (write(socket_.handle(), frame, size) < 0 && errno != ENOBUFS && errno != EAGAIN) {
      throw std::runtime_error(fmt::format(
          "CAN interface '{}' does not take the frames of {} ({}); CAN FD needs 'ip link set {} mtu 72'",
          interface_, info_of(fault_.fault.kind).name, std::generic_category().message(errno), interface_));
    }
  }

  TimedFault fault_;
  RandomFrames frames_;
  std::string interface_;
  host::CanSocket socket_;
};

}  // namespace

std::unique_ptr<FrameFault> make_foreign_frames(const TimedFault& fault, const Random& random,
                                                const std::string& interface) {
  if (!info_of(fault.fault.kind).real_bus) {
    return nullptr;
  }
  return std::make_unique<ForeignFrames>(fault, random, interface);
}

}  // namespace striker::sil

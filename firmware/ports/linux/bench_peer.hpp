// SPDX-License-Identifier: Apache-2.0
// The other end of an in-process bus: plays drives that follow the set-points with a lag, a camera that sees
// the robot where its wheels took it and a ball come closer, and an operator who arms the controller for one kick after
// the other, and clears its faults. So every code path of a kick runs, without a world.
#pragma once

#include "firmware/can/codec.hpp"
#include "firmware/core/state.hpp"
#include "firmware/ports/linux/in_process_bus.hpp"

namespace striker::linux_port {

class BenchPeer {
 public:
  explicit BenchPeer(InProcessBus& bus) : bus_(&bus) {}

  // Once a tick: takes the controller's frames, and sends what is due.
  void tick(std::int64_t now_ns);

 private:
  void take(const can::Frame& frame, std::int64_t now_ns);
  void send_picture(std::int64_t now_ns);
  void operate(std::int64_t now_ns);
  void order(can::Mode mode, std::int32_t challenge, std::int64_t now_ns);

  InProcessBus* bus_;
  std::uint32_t tick_ = 0;
  can::WheelState wheels_;
  std::int32_t travelled_um_ = 0;  // in this round
  can::Status status_;
  can::SendCounter wheel_counter_;
  can::SendCounter pose_counter_;
  can::SendCounter ball_counter_;
  can::SendCounter mode_counter_;
};

}  // namespace striker::linux_port

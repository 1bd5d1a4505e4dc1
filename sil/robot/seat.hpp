// SPDX-License-Identifier: Apache-2.0
// One robot's place in a scenario: its motors, drives, camera and the link to its controller, all on one bus
// of its own, and what they do in a tick:
//
//   queue, take_picture   what this tick brings: an operator's order, a picture
//   begin_tick            sends it, then the wheel states, then SYNC in lockstep; does not wait
//   end_tick              waits for the controller's answer and hands it to the drives
//   actuate, sense        the motors, before and after the world's step
//
// A scenario with many seats calls `begin_tick` of all, then `end_tick` of all. A seat owns none of its parts:
// a fault is another plant, drives, camera or link in the same place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "firmware/can/codec.hpp"
#include "sil/bus/controller_link.hpp"
#include "sil/robot/camera.hpp"
#include "sil/robot/plant.hpp"
#include "sil/robot/vision_sender.hpp"
#include "sil/robot/wheel_drives.hpp"

namespace striker::sil {

// All of them outlive the seat.
struct SeatParts {
  std::size_t robot = 0;  // its number in the world; plant and camera are of the same
  Plant& plant;
  WheelDrives& drives;
  Camera& camera;
  ControllerLink& link;
  bool lockstep = true;  // SYNC ends every tick
};

class Seat {
 public:
  explicit Seat(const SeatParts& parts);

  // Sent with the next `begin_tick`, in this order.
  void queue(const can::Frame& frame) { queued_.push_back(frame); }
  // Its frames leave in `latency_ticks`; a robot that is placed anew forgets those that have not,
  // and their numbers with them.
  void take_picture(const World& world, std::uint32_t tick, std::uint32_t latency_ticks = 0);

  void begin_tick(std::uint32_t tick);
  void end_tick(std::uint32_t tick);

  // The robot was placed, at rest.
  void reset() {
    late_.clear();
    parts_.plant.reset();
  }
  void actuate(World& world, std::uint32_t tick);
  void sense(const World& world) { parts_.plant.sense(world); }

  [[nodiscard]] std::size_t robot() const { return parts_.robot; }
  [[nodiscard]] std::uint32_t ticks_per_step() const { return parts_.plant.ticks_per_step(); }

  // The controller's answer in this tick. Valid until the next `begin_tick`.
  [[nodiscard]] std::span<const can::Frame> answer() const { return answer_; }

  // The tick's frames on the bus with their stamps: the seat's, then the answer, all at the tick, or as they
  // were received where the bus takes time. Valid until the next `begin_tick`.
  [[nodiscard]] std::span<const StampedFrame> traffic() const;

 private:
  SeatParts parts_;
  VisionSender vision_;
  can::SendCounter sync_counter_;
  struct Late {
    std::uint32_t tick;
    Picture picture;
  };
  std::deque<Late> late_;  // by their ticks
  std::vector<can::Frame> queued_;
  std::vector<can::Frame> answer_;
  std::vector<StampedFrame> traffic_;
};

}  // namespace striker::sil

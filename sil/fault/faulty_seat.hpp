// SPDX-License-Identifier: Apache-2.0
// A seat all of whose parts may be faulty: puts a case's faults between the seat and its parts, in one order.
//
//   seat ─ tap ─ frames and node ─ second controller ─ tap ─ brown-out ─ link      camera, drives, plant: one
//                                                                                  decorator a fault
//
// Without faults it is the seat that it would be without it, byte for byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/fault/faulty_link.hpp"
#include "sil/fault/link/link_faults.hpp"
#include "sil/fault/plan/fault_plan.hpp"
#include "sil/fault/watch/invariants.hpp"
#include "sil/robot/camera.hpp"
#include "sil/robot/seat.hpp"

namespace striker::sil {

// All of them outlive the seat.
struct SoundParts {
  std::size_t robot = 0;
  Plant& plant;
  WheelDrives& drives;
  Camera& camera;
  ControllerLink& link;
  InProcessLink* controller = nullptr;  // the same link, where the controller is in this process
  std::string interface = {};           // else SocketCAN's
};

class FaultySeat {
 public:
  // Throws std::runtime_error that names the kind, if one cannot be on this bus.
  FaultySeat(const SoundParts& parts, const std::vector<TimedFault>& faults, std::uint64_t seed,
             double torque_scale = 1.0);
  FaultySeat(const FaultySeat&) = delete;
  FaultySeat& operator=(const FaultySeat&) = delete;

  [[nodiscard]] Seat& seat() { return *seat_; }
  // To be the first of the run's observers: it keeps the time of cameras and plants.
  [[nodiscard]] Observer& clock() { return clock_; }
  [[nodiscard]] WatchedParts watched() const;
  [[nodiscard]] std::vector<std::uint32_t> reboots() const;
  // How many frames of the last tick did not come out at the other end, in it and as they were: lost, late or altered,
  // to the controller or from it.
  [[nodiscard]] int frames_not_through() const;

 private:
  class Clock final : public Observer {
   public:
    void end_tick(const Snapshot& snapshot) override { next_ = snapshot.tick + 1; }
    [[nodiscard]] const std::uint32_t& next() const { return next_; }

   private:
    std::uint32_t next_ = 0;
  };

  [[nodiscard]] ControllerLink& add_link_faults(const std::vector<TimedFault>& faults, std::uint64_t seed);
  void add_part_faults(const std::vector<TimedFault>& faults, std::uint64_t seed, double torque_scale);

  SoundParts parts_;
  Clock clock_;
  std::vector<std::uint32_t> reboots_;
  std::vector<std::unique_ptr<ControllerLink>> links_;
  std::unique_ptr<LinkTap> at_controller_;
  std::unique_ptr<LinkTap> at_seat_;
  std::vector<std::unique_ptr<Camera>> cameras_;
  std::vector<std::unique_ptr<WheelDrives>> drives_;
  std::vector<std::unique_ptr<Plant>> plants_;
  std::unique_ptr<Seat> seat_;
};

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// A kick with any kind of drives at both ends of the bus: controller, command gate and virtual drives of one wiring.
// Striker's own identifiers are moved (tests/drives/CMakeLists.txt).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "firmware/can/drives/drives_of.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/robot/drives/foreign_drives.hpp"
#include "sil/robot/variation.hpp"
#include "sil/scenario/kick_scenario.hpp"

namespace striker::sil {

// As in firmware/robots/forward-odrive.toml and forward-cia402.toml.
inline constexpr can::DriveWiring odrive_wiring = loop::built_in_wiring;
inline constexpr can::DriveWiring cia402_wiring = {.kind = can::DriveKind::cia402,
                                                   .identifier_base = 768,
                                                   .left_node = 1,
                                                   .right_node = 2,
                                                   .right_reversed = 1,
                                                   .gear_percent = 500,
                                                   .rated_torque_mNm = 80};
inline constexpr can::DriveWiring own_wiring = {.identifier_base = 768};

template <can::DriveWiring wiring>
using WiredNode = loop::ControllerNode<core::Controller<loop::BuiltInPilot>, can::DrivesOf<wiring>>;

inline const can::DriveWiring& wiring_of(can::DriveKind kind) {
  return kind == can::DriveKind::odrive   ? odrive_wiring
         : kind == can::DriveKind::cia402 ? cia402_wiring
                                          : own_wiring;
}

inline std::unique_ptr<ControllerLink> make_link(can::DriveKind kind) {
  switch (kind) {
    case can::DriveKind::odrive:
      return std::make_unique<NodeLink<WiredNode<odrive_wiring>>>();
    case can::DriveKind::cia402:
      return std::make_unique<NodeLink<WiredNode<cia402_wiring>>>();
    case can::DriveKind::striker:
      break;
  }
  return std::make_unique<NodeLink<WiredNode<own_wiring>>>();
}

class DriveRig {
 public:
  explicit DriveRig(can::DriveKind kind) : DriveRig(kind, make_drives(wiring_of(kind))) {}
  DriveRig(can::DriveKind kind, std::unique_ptr<WheelDrives> wheel_drives)
      : drives(std::move(wheel_drives)),
        link_(make_link(kind)),
        plants_(make_plants(PlantKind::drive, robot_spec(Role::forward), {})),
        camera_(make_camera({}, 1)),
        seat_({.plant = *plants_.back(), .drives = *drives, .camera = *camera_, .link = *link_}) {}

  std::vector<KickOutcome> play(
      const KickPlan& plan, const std::vector<Observer*>& observers = {},
      const std::function<bool()>& stop = [] { return false; }) {
    KickScenario scenario(plan, seat_, observers);
    scenario.run(stop);
    undriven = scenario.undriven();
    return scenario.outcomes();
  }

  // To the controller, with the next tick.
  void queue(const can::Frame& frame) { seat_.queue(frame); }

  std::unique_ptr<WheelDrives> drives;
  std::vector<std::uint64_t> undriven;  // of the last play

 private:
  std::unique_ptr<ControllerLink> link_;
  std::vector<std::unique_ptr<Plant>> plants_;
  std::unique_ptr<Camera> camera_;
  Seat seat_;
};

}  // namespace striker::sil

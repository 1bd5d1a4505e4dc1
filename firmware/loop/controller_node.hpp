// SPDX-License-Identifier: Apache-2.0
// The controller as a node of the bus: frames in, one step, frames out.
//
// It puts the three parts together that know nothing of each other: what was received (firmware/can), what is
// done about it (firmware/core), and what is told (firmware/can again). A value like its parts: several nodes
// of several robots and policies live in one process or image, and a copy goes on alone.
//
//   ControllerNode<core::Controller<core::Pilot<policy::kick>>, can::StrikerDrives> node(robot);
//   can::FrameList frames;
//   node.step({.number = tick, .frames = received}, {}, frames);
//
// Nobody sends what it makes as it is: GatedNode puts the command gate behind it.
#pragma once

#include <algorithm>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/can/receiver.hpp"
#include "firmware/can/reporter.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/loop/tick.hpp"

namespace striker::loop {

// What the command gate did, for telemetry (firmware/safety/command_gate.hpp).
struct GateReport {
  std::uint32_t limits = 0;
  std::uint32_t blocked = 0;
  bool has_blocked = false;  // and was not cleared since: a fault
};

template <class ControllerType, can::DriveProtocol DrivesType>
class ControllerNode {
 public:
  using Drives = DrivesType;

  // `seed` begins the controller's sequence of challenges; 0 is for simulations (core/supervision/consent.hpp).
  explicit constexpr ControllerNode(const core::RobotProfile& robot, std::uint32_t seed = 0)
      : controller_(robot, seed) {}

  // Replaces what is in `frames`.
  void step(const Tick& tick, const GateReport& gate, can::FrameList& frames) {
    if (tick.restart) {
      restart();
    }
    lost_frames_ = std::min(lost_frames_ + tick.lost_frames, greatest_count);
    frames.clear();
    core::Actions actions;
    controller_.step(
        {.tick = tick.number,
         .percepts = receiver_.take(tick.frames, tick.number, drives_),
         .port_faults = tick.port_faults | core::set_if(gate.has_blocked, core::Fault::gate_blocked) |
                        drive_faults(tick.number),
         .stop = tick.stop},
        actions);
    reporter_.report(tick.number, actions, receiver_.ignored(),
                     {.timing = tick.timing,
                      .limits = gate.limits,
                      .blocked = gate.blocked,
                      .lost_frames = lost_frames_,
                      .repeat_fault = tick.repeat_fault},
                     ControllerType::Pilot::identity, frames);
    if constexpr (can::ForeignDrives<Drives>) {
      drives_.enable(actions.state == core::State::active);
    }
    drives_.put(actions.drive, frames);
  }

  void seed_challenges(std::uint32_t seed) { controller_.seed_challenges(seed); }

  [[nodiscard]] const ControllerType& controller() const { return controller_; }
  [[nodiscard]] const can::IgnoredFrames& ignored() const { return receiver_.ignored(); }

 private:
  static constexpr std::size_t end_of_tick = 1;  // lockstep adds it
  static_assert(can::Reporter::most_frames + can::most_drive_frames<Drives>() + end_of_tick <=
                can::FrameList::capacity);
  static_assert(
      can::shares_no_identifier<Drives>(),
      "STRIKER DRIVES: a node's identifier is one of Striker's own: choose other nodes, or move Striker's "
      "with identifier_base in the robot's description");

  static constexpr std::uint32_t greatest_count = 255;

  // After this tick's frames were received.
  core::Faults drive_faults([[maybe_unused]] std::uint32_t tick) {
    if constexpr (can::ForeignDrives<Drives>) {
      return drives_.judge(tick);
    } else {
      return 0;
    }
  }

  // Apart from `step`, whose stack would hold the new parts too.
  [[gnu::noinline]] void restart() {
    receiver_ = {};
    drives_ = {};
    reporter_ = {};
    lost_frames_ = 0;
    controller_.begin_anew();
  }

  can::Receiver receiver_;
  Drives drives_;
  ControllerType controller_;
  can::Reporter reporter_;
  std::uint32_t lost_frames_ = 0;
};

}  // namespace striker::loop

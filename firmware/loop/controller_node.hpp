// SPDX-License-Identifier: Apache-2.0
// The controller as a node of the bus: frames in, one step, frames out.
//
// It puts the three parts together that know nothing of each other: what was received (firmware/can), what is
// done about it (firmware/core), and what is told (firmware/can again). A value like its parts: several nodes
// of several robots and policies live in one process or image, and a copy goes on alone.
//
//   ControllerNode<core::Controller<core::Pilot<policy::kick>>, can::StrikerDrives> node(robot);
//   can::FrameList frames;
//   node.step({.number = tick, .frames = received}, frames);   // then send `frames` in their order
#pragma once

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/can/receiver.hpp"
#include "firmware/can/reporter.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/loop/tick.hpp"

namespace striker::loop {

template <class ControllerType, can::DriveProtocol DrivesType>
class ControllerNode {
 public:
  using Drives = DrivesType;

  explicit constexpr ControllerNode(const core::RobotProfile& robot) : controller_(robot) {}

  // Replaces what is in `frames`.
  void step(const Tick& tick, can::FrameList& frames) {
    if (tick.restart) {
      restart();
    }
    frames.clear();
    core::Actions actions;
    controller_.step({.tick = tick.number,
                      .percepts = receiver_.take(tick.frames, tick.number, drives_),
                      .port_fault = tick.port_fault,
                      .stop = tick.stop},
                     actions);
    reporter_.report(tick.number, actions, receiver_.ignored(), tick.timing, ControllerType::Pilot::identity,
                     frames);
    drives_.put(actions.drive, frames);
  }

  [[nodiscard]] const ControllerType& controller() const { return controller_; }
  [[nodiscard]] const can::IgnoredFrames& ignored() const { return receiver_.ignored(); }

 private:
  static constexpr std::size_t end_of_tick = 1;  // lockstep adds it
  static_assert(can::Reporter::most_frames + Drives::sends.size() + end_of_tick <= can::FrameList::capacity);

  // Apart from `step`, whose stack would hold the new node too.
  [[gnu::noinline]] void restart() { *this = ControllerNode(controller_.robot()); }

  can::Receiver receiver_;
  Drives drives_;
  ControllerType controller_;
  can::Reporter reporter_;
};

}  // namespace striker::loop

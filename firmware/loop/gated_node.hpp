// SPDX-License-Identifier: Apache-2.0
// A controller's node behind its command gate: the whole way from received frames to frames that may be sent, as
// the tick loop and every own main loop use it.
//
//   GatedNode<ControllerNode<core::Controller<core::Pilot<policy::kick>>, can::StrikerDrives>> node(robot);
//   can::FrameList frames;
//   node.step({.number = tick, .frames = received}, frames);   // then send `frames` in their order
//
// A value like its parts. What the gate stopped is a fault of the controller's in the next step.
#pragma once

#include <cstdint>

#include "firmware/can/frame_list.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/loop/tick.hpp"
#include "firmware/safety/command_gate.hpp"

namespace striker::loop {

// A torque may go from one limit to the other in a tick, as the wheel loops do at a new set-point.
[[nodiscard]] constexpr safety::GateLimits gate_limits_of(const core::RobotProfile& robot) {
  return {.torque_mNm = robot.torque_limit_mNm,
          .slew_mNm = 2 * robot.torque_limit_mNm,
          .set_point_mm_s = robot.top_rim_speed_mm_s};
}

template <class Node>
class GatedNode {
 public:
  using Gate = safety::CommandGate<typename Node::Drives>;

  // `seed`: core/supervision/consent.hpp.
  explicit constexpr GatedNode(const core::RobotProfile& robot, std::uint32_t seed = 0)
      : node_(robot, seed), gate_(gate_limits_of(robot)) {}

  // Replaces what is in `frames`. A function of its own in every image: tools/step-bound proves how long it takes at most.
  [[gnu::noinline]] void step(const Tick& tick, can::FrameList& frames) {
    if (tick.restart) {
      gate_.restart();
    }
    gate_.take(tick.frames, tick.number);
    node_.step(
        tick,
        {.limits = gate_.active_limits(), .blocked = gate_.blocked(), .has_blocked = gate_.has_blocked()},
        frames);
    gate_.check(frames, tick.number);
  }

  // Before the first step, where the seed is known at run time alone.
  void seed_challenges(std::uint32_t seed) { node_.seed_challenges(seed); }

  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] const auto& controller() const { return node_.controller(); }
  [[nodiscard]] const Gate& gate() const { return gate_; }

 private:
  Node node_;
  Gate gate_;
};

}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// The controller in a main loop of your own: this file, a timer, and a CAN controller.
#include <array>
#include <cstddef>
#include <span>

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/loop/controller_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "firmware/policy/exported/kick.hpp"
#include "own_port.hpp"

namespace {

using namespace striker;

// The robot and the policy are yours: others are other arguments here.
using Pilot = core::Pilot<policy::kick>;
constexpr core::RobotProfile robot = core::profile_of(core::forward);
static_assert(Pilot::suits(robot));

// Statics, made by the compiler: no heap, and the linker knows what they take.
constinit loop::GatedNode<loop::ControllerNode<core::Controller<Pilot>, can::StrikerDrives>> node(robot);
constinit can::FrameList answer;
constinit std::array<can::Frame, 24> received;  // more than 1 ms of a 1 Mbit/s bus holds

std::span<const can::Frame> receive_all() {
  std::size_t count = 0;
  while (count < received.size() && own_port::receive(received[count])) {
    ++count;
  }
  return std::span(received).first(count);
}

}  // namespace

int main() {
  node.seed_challenges(own_port::random_number());
  std::uint32_t tick = 0;
  while (own_port::wait_for_tick(tick)) {
    node.step({.number = tick, .frames = receive_all()}, answer);
    for (const can::Frame& frame : answer.frames()) {
      static_cast<void>(own_port::send(frame));  // the next tick brings a newer one
    }
  }
  return node.controller().state() == core::State::standby ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
// The loop of every port: next tick, one step, its frames out. On Linux and on boards, by the clock and in
// lockstep, under test and in a simulator it is this text.
//
//   ClockTicks ticks(clock, {...});  or  SyncTicks ticks;      // when, and on which frames
//   TickLoop<Node, Bus&, Ticks&> loop(robot, bus, ticks);
//   while (...) loop.turn();
//   loop.stop();
//
// A fault of the port goes into the very step whose torque it concerns: nothing is sent that does not know of
// it. A bus that is off or that lost frames is such a fault. What the bus does not take is counted. Every frame
// passes the command gate before it is sent, and what the gate stopped is a fault in the next step.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "firmware/can/bus_health.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/loop/gated_node.hpp"
#include "firmware/loop/tick.hpp"

namespace striker::loop {

// Bus and ticks are the loop's own, or references to what outlives it. A source of ticks has
//   next(bus)    std::optional<Tick>: the next one, or nothing yet
//   end(sent)    called after the step with its frames, before they are sent; may add to them
//   done()       called when they are sent
template <class Node, class BusType, class Ticks>
class TickLoop {
 public:
  // `seed`: core/supervision/consent.hpp.
  constexpr TickLoop(const core::RobotProfile& robot, BusType bus, Ticks ticks, std::uint32_t seed = 0)
      : bus_(std::forward<BusType>(bus)), ticks_(std::forward<Ticks>(ticks)), node_(robot, seed) {}

  // Before the first tick, where the seed is known at run time alone.
  void seed_challenges(std::uint32_t seed) { node_.seed_challenges(seed); }

  // One tick. False if there was none yet. A function of its own in every image: tools/step-bound proves how long it takes.
  [[gnu::noinline]] bool turn() {
    auto tick = ticks_.next(bus_);
    if (!tick) {
      return false;
    }
    see_port(*tick);
    last_tick_ = tick->number;
    node_.step(*tick, frames_);
    ticks_.end(frames_);
    send();
    ticks_.done();
    return true;
  }

  // The port stops: disarmed, with torque 0 sent.
  void stop() {
    node_.step({.number = last_tick_, .stop = true}, frames_);
    send();
  }

  [[nodiscard]] const Node& node() const { return node_.node(); }
  [[nodiscard]] std::remove_reference_t<BusType>& bus() { return bus_; }
  [[nodiscard]] std::remove_reference_t<Ticks>& ticks() { return ticks_; }
  [[nodiscard]] std::uint64_t dropped_frames() const { return dropped_frames_; }
  [[nodiscard]] const auto& gate() const { return node_.gate(); }

 private:
  void see_port(Tick& tick) {
    if (bus_.health() == can::BusHealth::bus_off) {
      tick.port_faults |= core::set_of(core::Fault::bus_off);
    }
    tick.lost_frames += bus_.lost();
    if (tick.lost_frames != 0) {
      tick.port_faults |= core::set_of(core::Fault::frames_lost);
    }
  }

  void send() {
    const std::span<const can::Frame> frames = frames_.frames();
    dropped_frames_ += frames.size() - bus_.try_send(frames);
  }

  BusType bus_;
  Ticks ticks_;
  GatedNode<Node> node_;
  can::FrameList frames_;
  std::uint32_t last_tick_ = 0;
  std::uint64_t dropped_frames_ = 0;
};

}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// The controller behind its gate, as every port runs it, between an honest world and an attacker who knows the
// table and its checksums, on a port whose clock, faults and losses are as bad as they get. What must hold on
// every tick stands in support/node_invariants.hpp.
#include <algorithm>
#include <array>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "tests/fuzz/support/honest_world.hpp"
#include "tests/fuzz/support/node_invariants.hpp"

namespace striker::fuzz {
namespace {

class NodeRig {
 public:
  explicit NodeRig(Bytes& bytes) : bytes_(bytes), node_(loop::built_in_robot, bytes.u8()) {}

  void run() {
    while (!bytes_.done()) {
      operate(bytes_.u8() & 31U);
    }
    step();
  }

 private:
  void operate(std::uint8_t operation) {
    switch (operation) {
      case letter('r'):
        return run_ticks(1 + bytes_.u8());
      case letter('a'):
        return put(world_.order(can::Mode::arm));
      case letter('c'):
        return put(world_.order(can::Mode::clear));
      case letter('y'):
        return put(world_.order(static_cast<can::Mode>(challenge_.mode), challenge_.challenge));
      case letter('d'):
        return put(world_.order(can::Mode::disarm));
      case letter('n'):
        return put(world_.order(can::Mode::renew));
      case letter('s'):
        return put(can::send(can::EmergencyStop{.source = bytes_.u8() % 16}, stop_));
      case letter('v'):
        world_.sends_vision = !world_.sends_vision;
        return;
      case letter('w'):
        world_.sends_wheels = !world_.sends_wheels;
        return;
      case letter('h'):
        world_.wheel_error_mm_s = bytes_.i16();
        return;
      case letter('g'):
        world_.camera_error_quarter_mm = bytes_.i16();
        return;
      default:
        return order_as_team(operation);
    }
  }

  void order_as_team(std::uint8_t operation) {
    switch (operation) {
      case letter('b'): {
        const std::int32_t left_mm_s = bytes_.i16();
        return put(can::send(can::WheelOrder{.left_mm_s = left_mm_s, .right_mm_s = bytes_.i16()}, team_));
      }
      case letter('u'):
        return put(can::send(can::MotionOrder{.number = bytes_.u8() % 4}, team_));
      default:
        return attack(operation);
    }
  }

  void attack(std::uint8_t operation) {
    switch (operation) {
      case letter('f'):
        return put(forged_frame(bytes_));
      case letter('x'):
        return put(raw_frame(bytes_));
      case letter('p'):
        return put(seen_[bytes_.u8() % seen_.size()]);
      case letter('m'): {
        can::Frame frame = seen_[bytes_.u8() % seen_.size()];
        frame.data[bytes_.u8() % 8] ^= static_cast<std::uint8_t>(1U << (bytes_.u8() % 8));
        return put(frame);
      }
      case letter('e'):
        age_ms_ = bytes_.u8();
        return;
      default:
        return break_port(operation);
    }
  }

  void break_port(std::uint8_t operation) {
    switch (operation) {
      case letter('j'):
        tick_.number += bytes_.u16();
        return;
      case letter('k'):
        tick_.number += bytes_.u32();
        return;
      case letter('z'):
        tick_.number -= 1;
        return;
      case letter('o'):
        tick_.port_faults = core::Faults{1} << (bytes_.u8() % core::fault_names.size()) & ~core::Faults{1};
        return;
      case letter('l'):
        tick_.lost_frames = bytes_.u8();
        return;
      case letter('q'):
        tick_.stop = true;
        return;
      case letter('t'):
        tick_.restart = true;
        return;
      case letter('i'):
        tick_.repeat_fault = true;
        return;
      default:
        return step();
    }
  }

  void put(const can::Frame& frame) { frames_.push_back(frame); }

  void run_ticks(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      step();
    }
  }

  void step() {
    for (can::Frame& frame : frames_) {
      frame.age_ms = age_ms_;
    }
    for (const can::Frame& frame : world_.tick()) {
      seen_[next_seen_++ % seen_.size()] = frame;
      put(frame);
    }
    tick_.frames = frames_;
    const Told before = told_of(node_);
    node_.step(tick_, sent_);
    invariants_.check(before, tick_, sent_.frames(), node_);
    listen();
    frames_.clear();
    age_ms_ = 0;
    tick_ = {.number = tick_.number + 1};
  }

  void listen() {
    for (const can::Frame& frame : sent_.frames()) {
      can::WheelCommand command;
      can::Challenge challenge;
      if (holds(frame, command)) {
        world_.obey(command);
      } else if (holds(frame, challenge)) {
        challenge_ = challenge;
      }
    }
  }

  Bytes& bytes_;
  loop::GatedNode<loop::BuiltInNode> node_;
  HonestWorld world_;
  Invariants invariants_;
  loop::Tick tick_;
  std::vector<can::Frame> frames_;  // of the next tick
  std::uint8_t age_ms_ = 0;         // of those that are not the world's
  can::FrameList sent_;
  can::Challenge challenge_;
  can::SendCounter stop_;
  can::SendCounter team_;
  std::array<can::Frame, 64> seen_{};  // of the honest world, for replay
  std::size_t next_seen_ = 0;
};

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  striker::fuzz::Bytes bytes(data, size);
  striker::fuzz::NodeRig(bytes).run();
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// A controller's node on a test bench: pictures every 50 ticks, wheel states every tick, each of which a test
// may withhold, and what it last answered.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "tests/loop/bench/consent.hpp"

namespace striker::loop {

class NodeRig {
 public:
  bool send_vision = true;
  bool send_wheels = true;
  std::uint32_t picture_late_ticks = 0;  // than every 50
  std::int32_t ball_y_quarter_mm = 0;    // where it begins to come straight to the robot
  std::int32_t robot_um = 0;             // where it stands, along x
  can::WheelState wheels;
  std::vector<can::Frame> extra;      // for the next tick only
  std::vector<can::Frame> delivered;  // in the last tick
  core::Faults port_faults = 0;
  GatedNode<BuiltInNode> node{built_in_robot};

  void tick() {
    std::vector<can::Frame> frames = std::exchange(extra, {});
    if (send_wheels) {
      frames.push_back(can::send(wheels, wheel_counter_));
    }
    if (send_vision && now_ % 50 == picture_late_ticks) {
      // The ball lies ahead, comes closer and goes away: something to decide about.
      const auto frame = static_cast<std::int32_t>(now_ / 50 % 16);
      const auto phase = static_cast<std::int32_t>(now_ % 8000);
      const std::int32_t x_quarter_mm = 8000 - (phase < 4000 ? phase : 8000 - phase);
      frames.push_back(can::send(
          can::VisionPose{.frame = frame, .x_quarter_mm = robot_um / can::um_per_quarter_mm}, pose_counter_));
      frames.push_back(can::send(can::VisionBall{.frame = frame,
                                                 .x_quarter_mm = x_quarter_mm,
                                                 .y_quarter_mm = ball_y_quarter_mm * x_quarter_mm / 8000},
                                 ball_counter_));
    }
    delivered = frames;
    step(frames);
  }

  void step(std::span<const can::Frame> frames) {
    answer({.number = now_, .frames = frames, .port_faults = port_faults});
    ++now_;
  }

  // A port hands something in between two ticks.
  void answer(const Tick& tick) {
    node.step(tick, sent);
    ASSERT_FALSE(sent.frames().empty());
    ASSERT_EQ(can::receive(frames().back(), command), can::Verdict::accepted);
    for (const can::Frame& frame : frames()) {
      can::Decision made;
      if (can::is<can::Decision>(frame) && can::unpack(frame, made) == can::Verdict::accepted) {
        decision = made;
      }
    }
  }

  // Time passes without a step.
  void skip(std::uint32_t ticks) { now_ += ticks; }

  void run(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      tick();
    }
  }

  // A disarm or a renewal goes out with the next tick. What takes consent is asked for in a tick of its own, and
  // confirmed with the next.
  void mode(can::Mode mode) {
    extra.push_back(operator_.command(mode));
    if (mode == can::Mode::arm || mode == can::Mode::clear) {
      tick();
      const auto confirmation = operator_.answer(frames());
      ASSERT_TRUE(confirmation) << "every request is answered with a challenge";
      extra.push_back(*confirmation);
    }
  }
  void stop() { extra.push_back(can::send(can::EmergencyStop{}, stop_counter_)); }

  void arm() {
    run(160);
    mode(can::Mode::arm);
    tick();
    ASSERT_EQ(state(), core::State::active);
    run(50);
  }

  [[nodiscard]] std::span<const can::Frame> frames() const { return sent.frames(); }
  [[nodiscard]] core::Faults faults() const { return node.controller().faults(); }
  [[nodiscard]] core::State state() const { return node.controller().state(); }
  [[nodiscard]] core::Fault fault() const { return node.controller().fault(); }
  [[nodiscard]] bool torque() const { return command.left_torque_mNm != 0 || command.right_torque_mNm != 0; }
  [[nodiscard]] std::uint32_t now() const { return now_; }

  can::WheelCommand command;
  std::optional<can::Decision> decision;  // the last one
  can::FrameList sent;                    // in the last tick

 private:
  std::uint32_t now_ = 0;
  can::SendCounter wheel_counter_;
  can::SendCounter pose_counter_;
  can::SendCounter ball_counter_;
  can::SendCounter stop_counter_;
  BenchOperator operator_;
};

}  // namespace striker::loop

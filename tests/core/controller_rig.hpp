// A controller on a test bench: pictures every 50 ticks, wheel states every tick, each of which a test may
// withhold, and the last wheel command.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <utility>
#include <vector>

#include "firmware/core/controller.hpp"

namespace striker::core {

class ControllerRig {
 public:
  bool send_vision = true;
  bool send_wheels = true;
  std::int32_t ball_y_quarter_mm = 0;  // where it begins to come straight to the robot
  can::WheelState wheels;
  std::vector<can::Frame> extra;  // for the next tick only
  Controller controller;

  void tick() {
    std::vector<can::Frame> frames = std::exchange(extra, {});
    if (send_wheels) {
      frames.push_back(can::send(wheels, wheel_counter_));
    }
    if (send_vision && now_ % 50 == 0) {
      // The ball lies ahead and comes closer: something to decide about.
      const auto frame = static_cast<std::int32_t>(now_ / 50 % 16);
      const std::int32_t x_quarter_mm = 8000 - static_cast<std::int32_t>(now_ % 4000);
      frames.push_back(can::send(can::VisionPose{.frame = frame}, pose_counter_));
      frames.push_back(can::send(can::VisionBall{.frame = frame,
                                                 .x_quarter_mm = x_quarter_mm,
                                                 .y_quarter_mm = ball_y_quarter_mm * x_quarter_mm / 8000},
                                 ball_counter_));
    }
    step(frames);
  }

  void step(std::span<const can::Frame> frames) {
    controller.step({.tick = now_, .frames = frames}, outputs);
    ASSERT_FALSE(outputs.frames().empty());
    ASSERT_EQ(can::receive(outputs.frames().back(), command_counter_, command), can::Verdict::accepted);
    ++now_;
  }

  void run(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      tick();
    }
  }

  void mode(can::Mode mode) {
    extra.push_back(can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_counter_));
  }
  void stop() { extra.push_back(can::send(can::EmergencyStop{}, stop_counter_)); }

  void arm() {
    run(160);
    mode(can::Mode::arm);
    tick();
    ASSERT_EQ(controller.state(), can::State::active);
    run(50);
  }

  [[nodiscard]] bool torque() const { return command.left_torque_mNm != 0 || command.right_torque_mNm != 0; }
  [[nodiscard]] std::uint32_t now() const { return now_; }

  can::WheelCommand command;
  Outputs outputs;

 private:
  std::uint32_t now_ = 0;
  can::SendCounter wheel_counter_;
  can::SendCounter pose_counter_;
  can::SendCounter ball_counter_;
  can::SendCounter mode_counter_;
  can::SendCounter stop_counter_;
  can::ReceiveCounter command_counter_;
};

}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// Drives, camera and operator that do as they should, so that a fuzzed controller arms and drives: two wheels
// that follow their torque, a robot that rolls as they do, and a ball that rests.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"

namespace striker::fuzz {

class HonestWorld {
 public:
  bool sends_vision = true;
  bool sends_wheels = true;
  std::int32_t wheel_error_mm_s = 0;  // of the left wheel's sensor
  std::int32_t camera_error_quarter_mm = 0;

  // What it sends in the next tick.
  std::vector<can::Frame> tick() {
    std::vector<can::Frame> frames;
    roll();
    if (sends_wheels) {
      frames.push_back(can::send(
          can::WheelState{.left_mm_s = std::clamp(rounded(left_mm_s_) + wheel_error_mm_s, -8000, 8000),
                          .right_mm_s = rounded(right_mm_s_)},
          wheels_));
    }
    if (sends_vision && ticks_ % 50 == 0) {
      const auto number = static_cast<std::int32_t>(ticks_ / 50 % 16);
      frames.push_back(can::send(can::VisionPose{.frame = number,
                                                 .x_quarter_mm = rounded(4 * x_mm_) + camera_error_quarter_mm,
                                                 .y_quarter_mm = rounded(4 * y_mm_),
                                                 .heading = heading()},
                                 pose_));
      frames.push_back(can::send(can::VisionBall{.frame = number, .x_quarter_mm = 6000}, ball_));
    }
    ++ticks_;
    return frames;
  }

  void obey(const can::WheelCommand& command) { command_ = command; }

  can::Frame order(can::Mode mode, std::int32_t challenge = 0) {
    return can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                     mode_);
  }

 private:
  static std::int32_t rounded(double value) { return static_cast<std::int32_t>(std::lround(value)); }

  // A mNm on each wheel gains 27.8 mm/s^2 (firmware/core/robot_profile.hpp); rolling costs a little.
  static double rolled(double speed_mm_s, std::int32_t torque_mNm) {
    return std::clamp(0.999 * speed_mm_s + 0.0278 * torque_mNm, -3000.0, 3000.0);
  }

  void roll() {
    left_mm_s_ = rolled(left_mm_s_, command_.left_torque_mNm);
    right_mm_s_ = rolled(right_mm_s_, command_.right_torque_mNm);
    turned_ += (right_mm_s_ - left_mm_s_) / 140.0 * 1e-3;
    const double way_mm = (left_mm_s_ + right_mm_s_) / 2 * 1e-3;
    // The field's edge holds nobody here: the robot comes back on the other side of the camera's range.
    x_mm_ = std::remainder(x_mm_ + way_mm * std::cos(turned_), 16'000.0);
    y_mm_ = std::remainder(y_mm_ + way_mm * std::sin(turned_), 16'000.0);
  }

  [[nodiscard]] std::int32_t heading() const {
    const double circles = turned_ / (2 * std::numbers::pi);
    return static_cast<std::int16_t>(rounded((circles - std::floor(circles)) * 65536.0) & 0xFFFF);
  }

  can::WheelCommand command_;
  double left_mm_s_ = 0.0;
  double right_mm_s_ = 0.0;
  double x_mm_ = 0.0;
  double y_mm_ = 0.0;
  double turned_ = 0.0;
  std::uint32_t ticks_ = 0;
  can::SendCounter wheels_;
  can::SendCounter pose_;
  can::SendCounter ball_;
  can::SendCounter mode_;
};

}  // namespace striker::fuzz

// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/vision_sender.hpp"

#include <cmath>
#include <numbers>

namespace striker::sil {

namespace {

std::int32_t to_quarter_mm(double metres) {
  return static_cast<std::int32_t>(std::lround(metres * 4000.0));
}

std::int32_t to_binary_angle(double radians) {
  const auto counts = static_cast<std::int64_t>(std::llround(radians / std::numbers::pi * 32768.0));
  return static_cast<std::int16_t>(counts & 0xFFFF);
}

}  // namespace

std::array<can::Frame, 2> VisionSender::frames(const Picture& picture) {
  const can::VisionPose pose{.frame = frame_,
                             .x_quarter_mm = to_quarter_mm(picture.robot.x_m),
                             .y_quarter_mm = to_quarter_mm(picture.robot.y_m),
                             .heading = to_binary_angle(picture.robot.heading_rad)};
  const can::VisionBall ball{.frame = frame_,
                             .x_quarter_mm = to_quarter_mm(picture.ball_m.x),
                             .y_quarter_mm = to_quarter_mm(picture.ball_m.y)};
  frame_ = (frame_ + 1) % core::picture_numbers;
  return {can::send(pose, pose_counter_), can::send(ball, ball_counter_)};
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Pictures as frames: positions without velocities, rounded to the signals'
// counts. Pose and ball of one picture share a 4-bit frame number.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/codec.hpp"
#include "sil/robot/camera.hpp"

namespace striker::sil {

class VisionSender {
 public:
  [[nodiscard]] std::array<can::Frame, 2> frames(const Picture& picture);

 private:
  can::SendCounter pose_counter_;
  can::SendCounter ball_counter_;
  std::int32_t frame_ = 0;
};

}  // namespace striker::sil

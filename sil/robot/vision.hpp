// The camera on the bus: exact positions every 50 ms (an AI Soccer frame), no velocities, rounded to the
// signals' counts. Pose and ball of one picture share a 4-bit frame number.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/codec.hpp"
#include "sil/world/world.hpp"

namespace striker::sil {

class Vision {
 public:
  [[nodiscard]] std::array<can::Frame, 2> picture(const Pose& robot, Vec2 ball_m);

 private:
  can::SendCounter pose_counter_;
  can::SendCounter ball_counter_;
  std::int32_t frame_ = 0;
};

}  // namespace striker::sil

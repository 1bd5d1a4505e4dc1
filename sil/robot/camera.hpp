// SPDX-License-Identifier: Apache-2.0
// What a camera sees: poses and positions as values, before they become frames. A sensor's fault is a Camera
// that changes the Picture of another; it forges no frame.
#pragma once

#include <cstddef>

#include "sil/world/world.hpp"

namespace striker::sil {

struct Picture {
  Pose robot;
  Vec2 ball_m;
};

class Camera {
 public:
  virtual ~Camera() = default;
  // Once every picture, with the world as it is now.
  [[nodiscard]] virtual Picture look(const World& world) = 0;
};

// Sees where one robot and the ball truly are.
class ExactCamera final : public Camera {
 public:
  explicit ExactCamera(std::size_t robot) : robot_(robot) {}
  [[nodiscard]] Picture look(const World& world) override {
    return {.robot = world.robot_pose(robot_), .ball_m = world.ball().position_m};
  }

 private:
  std::size_t robot_;
};

}  // namespace striker::sil

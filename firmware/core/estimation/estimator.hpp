// SPDX-License-Identifier: Apache-2.0
// Where robot and ball are, and how they move, from what is perceived: positions from the camera, 50 ms apart
// and without velocities, and wheel speeds every tick.
//
// The ball's velocity is the difference of the last two complete pictures over the time between their
// numbers. Between pictures the ball is led on along its velocity, and the robot along its heading by its
// wheel speeds. Positions in um; a speed in mm/s times a tick of 1 ms is a distance in um.
//
// Order within a tick: `reset` if there was a disarm, `take` of what came, `end_tick`, then `at` for that
// tick. Cost: `at` rotates one vector; everything else is a few additions, two divisions a picture.
#pragma once

#include <cstdint>

#include "firmware/core/estimation/angle.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/tick.hpp"

namespace striker::core {

// With more pictures lost than this between two, no velocity is drawn from them.
inline constexpr std::int32_t greatest_picture_step = 4;

struct Picture {
  std::int32_t number = 0;
  Vector robot_um;
  BinaryAngle heading = 0;
  Vector ball_um;
};

struct Estimate {
  Vector robot_um;
  BinaryAngle heading = 0;
  std::int32_t robot_speed_mm_s = 0;  // signed, along the heading
  Vector ball_um;
  Vector ball_velocity_mm_s;
};

class Estimator {
 public:
  // Forgets every picture (the robot or the ball may have been placed elsewhere); the wheel speed stays.
  void reset();

  void take(const RobotSighting& robot);
  void take(const BallSighting& ball);
  void take(const WheelSpeeds& wheels);

  // Ends the taking of this tick's percepts. True if a pair of robot and ball was completed in it.
  bool end_tick(std::uint32_t tick);

  // Two pictures near enough in time to draw a velocity from.
  [[nodiscard]] bool has_velocity() const { return has_velocity_; }

  [[nodiscard]] Estimate at(std::uint32_t tick) const;

 private:
  void take_picture(std::uint32_t tick);

  Picture incoming_;  // robot and ball arrive apart: complete when their numbers agree
  bool robot_waits_ = false;
  bool ball_waits_ = false;
  std::int32_t ball_picture_ = 0;

  Picture last_;
  std::uint32_t last_tick_ = 0;
  bool has_picture_ = false;
  bool has_velocity_ = false;
  Vector ball_velocity_mm_s_;
  std::int32_t travelled_um_ = 0;  // since the last picture
  std::uint32_t led_to_tick_ = 0;
  std::int32_t robot_speed_mm_s_ = 0;
};

}  // namespace striker::core

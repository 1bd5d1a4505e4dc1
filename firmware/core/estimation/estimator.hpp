// SPDX-License-Identifier: Apache-2.0
// Where robot and ball are, and how they move, from what is perceived: positions from the camera, 10 to 100 times a
// second and without velocities, and wheel speeds every tick (odometry.hpp).
//
// The ball's velocity is the difference of two complete pictures over the time between their numbers: of the last two,
// or of those about a decision apart where the camera is faster (span_a_decision): noise and rounding would grow with the
// rate. Between pictures the ball is led on along its velocity, and the robot along its heading by its wheel
// speeds. Positions in um; a speed in mm/s times a tick of 1 ms is a distance in um.
//
// A picture shows what was when it was taken: the profile's camera latency before it was received. It counts, for
// being fresh, from when it was received. One whose number does not fit the time since the last one, or that
// shows what cannot be (plausibility.hpp), is not taken: a camera whose numbers or positions have gone wrong
// becomes stale. After `vision_timeout_ticks` without one, the next begins anew, without a velocity.
//
// Order within a tick: `reset` if there was a disarm, `take` of what came, `end_tick`, then `at` for that
// tick. Cost: `at` rotates one vector; everything else is a few additions, two divisions a picture.
#pragma once

#include <cstdint>

#include "firmware/core/estimation/odometry.hpp"
#include "firmware/core/estimation/picture.hpp"
#include "firmware/core/estimation/plausibility.hpp"
#include "firmware/core/percepts.hpp"
#include "firmware/core/robot_profile.hpp"
#include "firmware/core/tick.hpp"

namespace striker::core {

struct Estimate {
  Vector robot_um;
  BinaryAngle heading = 0;
  std::int32_t robot_speed_mm_s = 0;  // signed, along the heading
  Vector ball_um;
  Vector ball_velocity_mm_s;
};

enum class PictureResult : std::uint8_t {
  none,         // no picture was completed in this tick
  between,      // one was, too soon after the last to measure motion
  taken,        // one was
  mismatched,   // one was, and the robot moved otherwise than its wheels since the last
  implausible,  // one was completed, and cannot be
};

[[nodiscard]] constexpr bool is_new(PictureResult result) {
  return result != PictureResult::none && result != PictureResult::implausible;
}

class Estimator {
 public:
  // Forgets every picture: the robot or the ball may have been placed elsewhere.
  void reset() { *this = {}; }

  void take(const RobotSighting& robot, std::uint32_t tick);
  void take(const BallSighting& ball, std::uint32_t tick);

  // Ends the taking of this tick's percepts. The odometry has come to this tick, and begins anew with a picture.
  PictureResult end_tick(const RobotProfile& robot, Odometry& odometry);

  // Two pictures of the right distance in time to draw a velocity from.
  [[nodiscard]] bool has_velocity() const { return has_velocity_ != 0; }
  // When the last picture was received.
  [[nodiscard]] std::uint32_t picture_tick() const { return last_tick_; }

  [[nodiscard]] Estimate at(std::uint32_t tick, const Odometry& odometry) const;

 private:
  bool pair_is_complete();
  PictureResult take_picture(const RobotProfile& robot, const Odometry& odometry);
  PictureResult measure(const RobotProfile& robot);
  void adopt(const RobotProfile& robot, std::uint32_t received_tick);
  void measure_from_here();

  // Whole words, as the state is sealed.
  Picture incoming_;  // robot and ball arrive apart: complete when their numbers agree
  std::uint32_t robot_waits_ = 0;
  std::uint32_t ball_waits_ = 0;
  std::uint32_t robot_tick_ = 0;  // when each was received
  std::uint32_t ball_tick_ = 0;
  std::int32_t ball_picture_ = 0;

  Picture last_;
  std::uint32_t last_tick_ = 0;   // when it was received,
  std::uint32_t taken_tick_ = 0;  // and when it was taken
  std::uint32_t has_picture_ = 0;
  std::uint32_t has_velocity_ = 0;
  Vector ball_velocity_mm_s_;

  Picture reference_;  // motion is measured from here: so many pictures and this way to the last
  std::int32_t pictures_ = 0;
  Way rolled_;
  PictureTiming timing_;
};

}  // namespace striker::core

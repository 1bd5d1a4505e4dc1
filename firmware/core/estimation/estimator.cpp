// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/estimator.hpp"

#include <algorithm>

#include "firmware/core/estimation/plausibility.hpp"

namespace striker::core {

namespace {

constexpr std::int32_t picture_period_ms = decision_period_ms;

// Both halves of a picture leave the camera together.
constexpr std::uint32_t greatest_apart_ticks = 25;

constexpr std::uint32_t camera_latency_of(const RobotProfile& robot) {
  return static_cast<std::uint32_t>(robot.camera_latency_ticks);
}

constexpr std::uint32_t distance(std::uint32_t one_tick, std::uint32_t other_tick) {
  return std::min(one_tick - other_tick, other_tick - one_tick);
}

}  // namespace

void Estimator::take(const RobotSighting& robot, std::uint32_t tick) {
  incoming_.number = robot.picture;
  incoming_.robot_um = robot.position_um;
  incoming_.heading = robot.heading;
  robot_tick_ = tick - robot.age_ticks;
  robot_waits_ = 1;
}

void Estimator::take(const BallSighting& ball, std::uint32_t tick) {
  ball_picture_ = ball.picture;
  incoming_.ball_um = ball.position_um;
  ball_tick_ = tick - ball.age_ticks;
  ball_waits_ = 1;
}

PictureResult Estimator::end_tick(const RobotProfile& robot, Odometry& odometry) {
  if (!pair_is_complete()) {
    return PictureResult::none;
  }
  const PictureResult result = take_picture(robot, odometry);
  if (result == PictureResult::taken || result == PictureResult::mismatched) {
    odometry.restart(taken_tick_);
  }
  return result;
}

bool Estimator::pair_is_complete() {
  if (robot_waits_ == 0 || ball_waits_ == 0 || incoming_.number != ball_picture_ ||
      distance(robot_tick_, ball_tick_) > greatest_apart_ticks) {
    return false;
  }
  robot_waits_ = 0;
  ball_waits_ = 0;
  return true;
}

PictureResult Estimator::take_picture(const RobotProfile& robot, const Odometry& odometry) {
  const std::uint32_t received_tick =
      std::max(robot_tick_ - last_tick_, ball_tick_ - last_tick_) + last_tick_;
  const std::uint32_t elapsed_ticks = received_tick - last_tick_;
  if (has_picture_ == 0 || elapsed_ticks > vision_timeout_ticks) {
    has_velocity_ = 0;
    adopt(robot, received_tick);
    return PictureResult::taken;
  }
  const std::int32_t pictures = (incoming_.number - last_.number) & (picture_numbers - 1);
  if (pictures == 0) {
    return PictureResult::none;
  }
  if (!number_fits(pictures, elapsed_ticks) || !is_possible(robot, last_, incoming_, pictures)) {
    return PictureResult::implausible;
  }
  const bool agrees =
      wheels_agree(robot, last_, incoming_, odometry.until(received_tick - camera_latency_of(robot)));
  const std::int32_t elapsed_ms = pictures * picture_period_ms;
  ball_velocity_mm_s_ = {(incoming_.ball_um.x - last_.ball_um.x) / elapsed_ms,
                         (incoming_.ball_um.y - last_.ball_um.y) / elapsed_ms};
  has_velocity_ = 1;
  adopt(robot, received_tick);
  return agrees ? PictureResult::taken : PictureResult::mismatched;
}

void Estimator::adopt(const RobotProfile& robot, std::uint32_t received_tick) {
  last_ = incoming_;
  last_tick_ = received_tick;
  taken_tick_ = received_tick - camera_latency_of(robot);
  has_picture_ = 1;
}

Estimate Estimator::at(std::uint32_t tick, const Odometry& odometry) const {
  const auto led_ticks = static_cast<std::int32_t>(std::min(tick - taken_tick_, greatest_led_ticks));
  const BinaryAngle heading = wrap_angle(last_.heading);
  const Vector travelled = rotate({odometry.travelled_um(), 0}, heading);
  return {{last_.robot_um.x + travelled.x, last_.robot_um.y + travelled.y},
          heading,
          odometry.speed_mm_s(),
          {last_.ball_um.x + ball_velocity_mm_s_.x * led_ticks,
           last_.ball_um.y + ball_velocity_mm_s_.y * led_ticks},
          ball_velocity_mm_s_};
}

}  // namespace striker::core

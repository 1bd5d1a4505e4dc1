// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/estimator.hpp"

#include <algorithm>

namespace striker::core {

namespace {

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
  if (is_new(result)) {
    odometry.restart(robot, taken_tick_);
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
    measure_from_here();
    return PictureResult::taken;
  }
  const std::int32_t pictures = (incoming_.number - last_.number) & (picture_numbers - 1);
  if (pictures == 0) {
    return PictureResult::none;
  }
  if (!timing_.fits(robot, pictures, elapsed_ticks) || !is_possible(robot, last_, incoming_, pictures)) {
    return PictureResult::implausible;
  }
  timing_.take(robot, pictures, elapsed_ticks);
  adopt(robot, received_tick);
  const Way rolled = odometry.until(taken_tick_);
  pictures_ += pictures;
  rolled_.travelled_um += rolled.travelled_um;
  rolled_.turned_um += rolled.turned_um;
  return span_a_decision(robot, pictures_) ? measure(robot) : PictureResult::between;
}

// From the reference to the last picture. In units of 8 us no product leaves 32 bits.
PictureResult Estimator::measure(const RobotProfile& robot) {
  const bool agrees = wheels_agree(robot, reference_, last_, rolled_);
  const std::int32_t elapsed_8us = pictures_ * robot.picture_period_us / 8;
  ball_velocity_mm_s_ = {(last_.ball_um.x - reference_.ball_um.x) * 125 / elapsed_8us,
                         (last_.ball_um.y - reference_.ball_um.y) * 125 / elapsed_8us};
  has_velocity_ = 1;
  measure_from_here();
  return agrees ? PictureResult::taken : PictureResult::mismatched;
}

void Estimator::measure_from_here() {
  reference_ = last_;
  pictures_ = 0;
  rolled_ = {};
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

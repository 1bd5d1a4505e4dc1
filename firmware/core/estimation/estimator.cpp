// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/estimation/estimator.hpp"

#include <algorithm>

namespace striker::core {

namespace {

// Far beyond the limit of freshness; it keeps every product within 32 bits.
constexpr std::uint32_t greatest_led_ticks = 1000;
static_assert(greatest_led_ticks > vision_timeout_ticks);

constexpr std::int32_t picture_period_ms = decision_period_ms;

}  // namespace

void Estimator::reset() {
  const Estimator before = *this;
  *this = Estimator{};
  robot_speed_mm_s_ = before.robot_speed_mm_s_;
  led_to_tick_ = before.led_to_tick_;
}

void Estimator::take(const RobotSighting& robot) {
  incoming_.number = robot.picture;
  incoming_.robot_um = robot.position_um;
  incoming_.heading = robot.heading;
  robot_waits_ = true;
}

void Estimator::take(const BallSighting& ball) {
  ball_picture_ = ball.picture;
  incoming_.ball_um = ball.position_um;
  ball_waits_ = true;
}

void Estimator::take(const WheelSpeeds& wheels) {
  robot_speed_mm_s_ = (wheels.left_mm_s + wheels.right_mm_s) / 2;
}

bool Estimator::end_tick(std::uint32_t tick) {
  if (tick - last_tick_ <= greatest_led_ticks) {
    travelled_um_ += robot_speed_mm_s_ * static_cast<std::int32_t>(tick - led_to_tick_);
  }
  led_to_tick_ = tick;
  if (!robot_waits_ || !ball_waits_ || incoming_.number != ball_picture_) {
    return false;
  }
  robot_waits_ = false;
  ball_waits_ = false;
  if (has_picture_ && incoming_.number == last_.number) {
    return false;
  }
  take_picture(tick);
  return true;
}

void Estimator::take_picture(std::uint32_t tick) {
  const std::int32_t pictures = (incoming_.number - last_.number) & (picture_numbers - 1);
  has_velocity_ = has_picture_ && pictures <= greatest_picture_step;
  if (has_velocity_) {
    const std::int32_t elapsed_ms = pictures * picture_period_ms;
    ball_velocity_mm_s_ = {(incoming_.ball_um.x - last_.ball_um.x) / elapsed_ms,
                           (incoming_.ball_um.y - last_.ball_um.y) / elapsed_ms};
  }
  last_ = incoming_;
  last_tick_ = tick;
  has_picture_ = true;
  travelled_um_ = 0;
}

Estimate Estimator::at(std::uint32_t tick) const {
  const auto led_ticks = static_cast<std::int32_t>(std::min(tick - last_tick_, greatest_led_ticks));
  const Vector travelled = rotate({travelled_um_, 0}, last_.heading);
  return {{last_.robot_um.x + travelled.x, last_.robot_um.y + travelled.y},
          last_.heading,
          robot_speed_mm_s_,
          {last_.ball_um.x + ball_velocity_mm_s_.x * led_ticks,
           last_.ball_um.y + ball_velocity_mm_s_.y * led_ticks},
          ball_velocity_mm_s_};
}

}  // namespace striker::core

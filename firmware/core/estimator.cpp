#include "firmware/core/estimator.hpp"

#include <algorithm>

namespace striker::core {

namespace {

constexpr std::int32_t um_per_quarter_mm = 250;

// Far beyond the vision's freshness limit; it keeps every product within 32 bits.
constexpr std::uint32_t greatest_led_ticks = 1000;

constexpr Vector to_um(std::int32_t x_quarter_mm, std::int32_t y_quarter_mm) {
  return {x_quarter_mm * um_per_quarter_mm, y_quarter_mm * um_per_quarter_mm};
}

}  // namespace

void Estimator::reset() {
  const Estimator before = *this;
  *this = Estimator{};
  robot_speed_mm_s_ = before.robot_speed_mm_s_;
  led_to_tick_ = before.led_to_tick_;
}

void Estimator::take_pose(const can::VisionPose& pose) {
  incoming_.frame = pose.frame;
  incoming_.robot_um = to_um(pose.x_quarter_mm, pose.y_quarter_mm);
  incoming_.heading = wrap_angle(pose.heading);
  pose_waits_ = true;
}

void Estimator::take_ball(const can::VisionBall& ball) {
  ball_frame_ = ball.frame;
  incoming_.ball_um = to_um(ball.x_quarter_mm, ball.y_quarter_mm);
  ball_waits_ = true;
}

void Estimator::take_wheels(const can::WheelState& wheels) {
  robot_speed_mm_s_ = (wheels.left_mm_s + wheels.right_mm_s) / 2;
}

bool Estimator::end_tick(std::uint32_t tick) {
  if (tick - last_tick_ <= greatest_led_ticks) {
    travelled_um_ += robot_speed_mm_s_ * static_cast<std::int32_t>(tick - led_to_tick_);
  }
  led_to_tick_ = tick;
  if (!pose_waits_ || !ball_waits_ || incoming_.frame != ball_frame_) {
    return false;
  }
  pose_waits_ = false;
  ball_waits_ = false;
  if (has_picture_ && incoming_.frame == last_.frame) {
    return false;
  }
  take_picture(tick);
  return true;
}

void Estimator::take_picture(std::uint32_t tick) {
  const std::int32_t frames = (incoming_.frame - last_.frame) & 0xF;
  has_velocity_ = has_picture_ && frames <= greatest_frame_step;
  if (has_velocity_) {
    const std::int32_t elapsed_ms = frames * vision_period_ticks;
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

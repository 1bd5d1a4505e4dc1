// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/bench_peer.hpp"

namespace striker::linux_port {

namespace {

constexpr std::uint32_t picture_ticks = can::layout<can::VisionPose>.info.period_ms;
constexpr std::uint32_t operator_ticks = 200;  // longer than an operator's counter is remembered

// With a lag of 64 ticks, so that the wheel loops have torque to ask for.
std::int32_t follow(std::int32_t speed_mm_s, std::int32_t set_point_mm_s) {
  return speed_mm_s + (set_point_mm_s - speed_mm_s) / 64;
}

}  // namespace

void BenchPeer::tick(std::int64_t now_ns) {
  while (const auto frame = bus_->receive_from_controller()) {
    take(*frame);
  }
  bus_->send_to_controller(can::send(wheels_, wheel_counter_), now_ns);
  if (tick_ % picture_ticks == 0) {
    send_picture(now_ns);
  }
  if (tick_ % operator_ticks == operator_ticks - 1) {
    operate(now_ns);
  }
  ++tick_;
}

void BenchPeer::take(const can::Frame& frame) {
  can::ReceiveCounter any;
  can::WheelCommand command;
  can::Status status;
  if (can::is<can::WheelCommand>(frame) && can::receive(frame, any, command) == can::Verdict::accepted) {
    wheels_.left_mm_s = follow(wheels_.left_mm_s, 2 * command.left_set_point_2mm_s);
    wheels_.right_mm_s = follow(wheels_.right_mm_s, 2 * command.right_set_point_2mm_s);
  } else if (can::is<can::Status>(frame) && can::receive(frame, any, status) == can::Verdict::accepted) {
    state_ = static_cast<core::State>(status.state);
  }
}

void BenchPeer::send_picture(std::int64_t now_ns) {
  const auto number = static_cast<std::int32_t>(tick_ / picture_ticks);
  bus_->send_to_controller(can::send(can::VisionPose{.frame = number % core::picture_numbers}, pose_counter_),
                           now_ns);
  bus_->send_to_controller(can::send(can::VisionBall{.frame = number % core::picture_numbers,
                                                     .x_quarter_mm = 8000 - 200 * (number % 40)},
                                     ball_counter_),
                           now_ns);
}

void BenchPeer::operate(std::int64_t now_ns) {
  if (state_ == core::State::standby || state_ == core::State::fault) {
    const can::Mode mode = state_ == core::State::fault ? can::Mode::clear : can::Mode::arm;
    bus_->send_to_controller(
        can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode)}, mode_counter_), now_ns);
  }
}

}  // namespace striker::linux_port

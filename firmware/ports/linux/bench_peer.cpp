// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/bench_peer.hpp"

#include "firmware/loop/built_in_robot.hpp"

namespace striker::linux_port {

namespace {

// A round is a kick: the robot stands at the origin, two decisions' time later it is armed, 40 decisions, and again.
constexpr std::uint32_t round_ticks = 44 * core::decision_period_ticks;
constexpr std::uint32_t operator_ticks = 20;

// Of the built-in robot's camera: the number of the last one that was taken by this tick.
constexpr std::uint64_t picture_at(std::uint64_t tick) {
  constexpr std::uint64_t second_ticks = 1'000;
  return tick * static_cast<std::uint64_t>(loop::built_in_description.camera_rate_Hz) / second_ticks;
}

// With a lag of 64 ticks, so that the wheel loops have torque to ask for.
std::int32_t follow(std::int32_t speed_mm_s, std::int32_t set_point_mm_s) {
  return speed_mm_s + (set_point_mm_s - speed_mm_s) / 64;
}

}  // namespace

void BenchPeer::tick(std::int64_t now_ns) {
  while (const auto frame = bus_->receive_from_controller()) {
    take(*frame, now_ns);
  }
  bus_->send_to_controller(can::send(wheels_, wheel_counter_), now_ns);
  travelled_um_ += (wheels_.left_mm_s + wheels_.right_mm_s) / 2;
  if (tick_ % round_ticks == 0) {
    order(can::Mode::disarm, 0, now_ns);
    travelled_um_ = 0;
    wheels_ = {};
  }
  if (tick_ == 0 || picture_at(tick_) != picture_at(tick_ - 1)) {
    send_picture(now_ns);
  }
  if (tick_ % operator_ticks == operator_ticks - 1) {
    operate(now_ns);
  }
  ++tick_;
}

void BenchPeer::take(const can::Frame& frame, std::int64_t now_ns) {
  can::WheelCommand command;
  can::Status status;
  can::Challenge challenge;
  if (can::is<can::WheelCommand>(frame) && can::receive(frame, command) == can::Verdict::accepted) {
    wheels_.left_mm_s = follow(wheels_.left_mm_s, 2 * command.left_set_point_2mm_s);
    wheels_.right_mm_s = follow(wheels_.right_mm_s, 2 * command.right_set_point_2mm_s);
  } else if (can::is<can::Status>(frame) && can::receive(frame, status) == can::Verdict::accepted) {
    status_ = status;
  } else if (can::is<can::Challenge>(frame) && can::receive(frame, challenge) == can::Verdict::accepted) {
    order(static_cast<can::Mode>(challenge.mode), challenge.challenge, now_ns);
  }
}

void BenchPeer::send_picture(std::int64_t now_ns) {
  const auto number = static_cast<std::int32_t>(picture_at(tick_) % core::picture_numbers);
  const auto in_round_ticks = static_cast<std::int32_t>(tick_ % round_ticks);
  bus_->send_to_controller(
      can::send(can::VisionPose{.frame = number, .x_quarter_mm = travelled_um_ / can::um_per_quarter_mm},
                pose_counter_),
      now_ns);
  bus_->send_to_controller(
      can::send(can::VisionBall{.frame = number, .x_quarter_mm = 8000 - 3 * in_round_ticks}, ball_counter_),
      now_ns);
}

void BenchPeer::operate(std::int64_t now_ns) {
  const auto state = static_cast<core::State>(status_.state);
  if (state == core::State::fault) {
    order(can::Mode::clear, 0, now_ns);
  } else if (state == core::State::standby && status_.vision_ready != 0) {
    order(can::Mode::arm, 0, now_ns);
  }
}

void BenchPeer::order(can::Mode mode, std::int32_t challenge, std::int64_t now_ns) {
  bus_->send_to_controller(
      can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(mode), .challenge = challenge},
                mode_counter_),
      now_ns);
}

}  // namespace striker::linux_port

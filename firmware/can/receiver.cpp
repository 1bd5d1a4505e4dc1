// SPDX-License-Identifier: Apache-2.0
#include "firmware/can/receiver.hpp"

namespace striker::can {

namespace {

constexpr std::int32_t greatest_count = 255;

void count_up(std::int32_t& counter) {
  if (counter < greatest_count) {
    ++counter;
  }
}

core::Vector position_um(std::int32_t x_quarter_mm, std::int32_t y_quarter_mm) {
  return {x_quarter_mm * um_per_quarter_mm, y_quarter_mm * um_per_quarter_mm};
}

core::Order order_of(Mode mode) {
  return mode == Mode::arm ? core::Order::arm : mode == Mode::clear ? core::Order::clear : core::Order::none;
}

void request(const ModeCommand& command, bool in_order, core::Percepts& percepts) {
  const auto mode = static_cast<Mode>(command.mode);
  core::Requests& requests = percepts.requests;
  if (mode == Mode::disarm) {
    requests.disarm = true;
    percepts.robot.reset();
    percepts.ball.reset();
  } else if (mode == Mode::renew) {
    requests.renew = requests.renew || in_order;
  } else if (command.challenge == 0) {
    requests.asked = order_of(mode);
  } else {
    requests.confirmed = {order_of(mode), static_cast<std::uint32_t>(command.challenge)};
  }
}

// What a team's frame orders, if it is sound by itself.
Verdict check_order(const Frame& frame, core::TeamOrder& order) {
  order = {.is_motion = is<MotionOrder>(frame), .age_ticks = frame.age_ms};
  if (order.is_motion) {
    MotionOrder motion;
    const Verdict verdict = receive(frame, motion);
    order.number = static_cast<std::uint8_t>(motion.number);
    return verdict;
  }
  WheelOrder wheels;
  const Verdict verdict = receive(frame, wheels);
  order.speeds = {wheels.left_mm_s, wheels.right_mm_s};
  return verdict;
}

}  // namespace

void IgnoredFrames::count(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      break;
    case Verdict::wrong_length:
      return count_up(wrong_length);
    case Verdict::wrong_crc:
      return count_up(wrong_crc);
    case Verdict::wrong_counter:
      return count_up(wrong_counter);
    case Verdict::out_of_range:
      return count_up(out_of_range);
  }
}

void Receiver::take_frame(const Frame& frame, std::uint32_t tick, core::Percepts& percepts) {
  if (is<VisionPose>(frame)) {
    VisionPose pose;
    if (accepted(pose_.take(frame, tick, pose))) {
      percepts.robot = {.picture = pose.frame,
                        .position_um = position_um(pose.x_quarter_mm, pose.y_quarter_mm),
                        .heading = core::wrap_angle(pose.heading),
                        .age_ticks = frame.age_ms};
    }
    percepts.invalid.vision = pose_.invalid() || percepts.invalid.vision;
  } else if (is<VisionBall>(frame)) {
    VisionBall ball;
    if (accepted(ball_.take(frame, tick, ball))) {
      percepts.ball = {.picture = ball.frame,
                       .position_um = position_um(ball.x_quarter_mm, ball.y_quarter_mm),
                       .age_ticks = frame.age_ms};
    }
    percepts.invalid.vision = ball_.invalid() || percepts.invalid.vision;
  } else if (is<WheelOrder>(frame) || is<MotionOrder>(frame)) {
    take_order(frame, tick, percepts);
  } else if (is<ModeCommand>(frame)) {
    ModeCommand command;
    if (operators(receive(frame, command), percepts)) {
      request(command, operator_order_.take_correct(counter_of(frame), true), percepts);
    }
  } else if (is<EmergencyStop>(frame)) {
    EmergencyStop stop;
    percepts.emergency_stop = operators(receive(frame, stop), percepts) || percepts.emergency_stop;
  } else if (is<Status>(frame)) {
    percepts.second_controller = true;
  }
}

void Receiver::take_order(const Frame& frame, std::uint32_t tick, core::Percepts& percepts) {
  constexpr static FrameSequence::Rules rules = {.window = slow_window,
                                                 .timeout_ticks = core::order_timeout_ticks};
  core::TeamOrder order;
  const Verdict found = check_order(frame, order);
  if (accepted(orders_.take(rules, frame, tick, found))) {
    percepts.order = order;
  }
  percepts.invalid.orders = orders_.invalid();
}

// An operator's frames are events: any counter will do but for a renewal, and what is wrong is remembered.
bool Receiver::operators(Verdict verdict, core::Percepts& percepts) {
  percepts.invalid.operators = percepts.invalid.operators || verdict != Verdict::accepted;
  return accepted(verdict);
}

}  // namespace striker::can

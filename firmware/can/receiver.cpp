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

void request(Mode mode, core::Percepts& percepts) {
  switch (mode) {
    case Mode::disarm:
      percepts.requests.disarm = true;
      percepts.robot.reset();
      percepts.ball.reset();
      break;
    case Mode::arm:
      percepts.requests.arm = true;
      break;
    case Mode::clear:
      percepts.requests.clear = true;
      break;
  }
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
                        .heading = core::wrap_angle(pose.heading)};
    }
  } else if (is<VisionBall>(frame)) {
    VisionBall ball;
    if (accepted(ball_.take(frame, tick, ball))) {
      percepts.ball = {.picture = ball.frame,
                       .position_um = position_um(ball.x_quarter_mm, ball.y_quarter_mm)};
    }
  } else if (is<ModeCommand>(frame)) {
    ModeCommand command;
    if (accepted(mode_.take(frame, tick, command))) {
      request(static_cast<Mode>(command.mode), percepts);
    }
  } else if (is<EmergencyStop>(frame)) {
    EmergencyStop stop;
    percepts.emergency_stop = accepted(stop_.take(frame, tick, stop)) || percepts.emergency_stop;
  }
}

}  // namespace striker::can

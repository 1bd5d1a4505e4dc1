#include "firmware/core/inbox.hpp"

namespace striker::core {

namespace {

void count_up(std::int32_t& counter) {
  counter += static_cast<std::int32_t>(counter < 255);
}

}  // namespace

void Inbox::count(can::Verdict verdict) {
  switch (verdict) {
    case can::Verdict::accepted:
      break;
    case can::Verdict::wrong_length:
      return count_up(ignored_.wrong_length);
    case can::Verdict::wrong_crc:
      return count_up(ignored_.wrong_crc);
    case can::Verdict::wrong_counter:
      return count_up(ignored_.wrong_counter);
    case can::Verdict::out_of_range:
      return count_up(ignored_.out_of_range);
  }
}

template <class Message>
bool Inbox::accept(const can::Frame& frame, std::uint32_t tick, Receiver& receiver, Message& message) {
  constexpr std::uint32_t timeout_ms = can::layout<Message>.info.timeout_ms;
  constexpr std::uint32_t memory_ticks = timeout_ms != 0 ? timeout_ms : event_memory_ticks;
  receiver.counter.seen = receiver.counter.seen && receiver.accepted.within(tick, memory_ticks);
  const can::Verdict verdict = can::receive(frame, receiver.counter, message);
  count(verdict);
  if (verdict != can::Verdict::accepted) {
    return false;
  }
  receiver.accepted.feed(tick);
  return true;
}

void Inbox::take_mode(const can::Frame& frame, std::uint32_t tick, Estimator& estimator, Requests& requests) {
  can::ModeCommand command;
  if (!accept(frame, tick, mode_, command)) {
    return;
  }
  const auto mode = static_cast<can::Mode>(command.mode);
  if (mode == can::Mode::disarm) {
    estimator.reset();
  }
  requests.arm = requests.arm || mode == can::Mode::arm;
  requests.disarm = requests.disarm || mode == can::Mode::disarm;
  requests.clear = requests.clear || mode == can::Mode::clear;
}

Requests Inbox::take(std::span<const can::Frame> frames, std::uint32_t tick, Estimator& estimator) {
  Requests requests;
  for (const can::Frame& frame : frames) {
    if (can::is<can::WheelState>(frame)) {
      if (accept(frame, tick, wheels_, wheel_state_)) {
        estimator.take_wheels(wheel_state_);
      }
    } else if (can::is<can::VisionPose>(frame)) {
      can::VisionPose pose;
      if (accept(frame, tick, pose_, pose)) {
        estimator.take_pose(pose);
      }
    } else if (can::is<can::VisionBall>(frame)) {
      can::VisionBall ball;
      if (accept(frame, tick, ball_, ball)) {
        estimator.take_ball(ball);
      }
    } else if (can::is<can::ModeCommand>(frame)) {
      take_mode(frame, tick, estimator, requests);
    } else if (can::is<can::EmergencyStop>(frame)) {
      can::EmergencyStop stop;
      accept(frame, tick, stop_, stop);
    }
  }
  return requests;
}

}  // namespace striker::core

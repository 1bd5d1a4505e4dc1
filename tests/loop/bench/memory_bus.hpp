// SPDX-License-Identifier: Apache-2.0
// A loop's surroundings in memory: a bus that goes off, takes no frame or is flooded, and everything that sends
// to a controller.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "firmware/can/codec.hpp"
#include "firmware/loop/bus.hpp"
#include "tests/loop/bench/consent.hpp"

namespace striker::loop {

template <class Time>
class MemoryBus {
 public:
  std::vector<can::Frame> waiting;
  std::vector<can::Frame> sent;  // since it was last cleared
  can::BusHealth now = can::BusHealth::active;
  std::uint32_t lost_frames = 0;
  std::size_t room = 100;  // frames that it takes in a tick

  void poll() {}
  Received<Time> receive(std::size_t most) {
    const std::size_t count = std::min(most, waiting.size());
    batch_.assign(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
    return {.frames = batch_, .oldest = 0};
  }
  std::size_t try_send(std::span<const can::Frame> frames) {
    const std::size_t taken = std::min(room, frames.size());
    sent.insert(sent.end(), frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(taken));
    return taken;
  }
  [[nodiscard]] can::BusHealth health() const { return now; }
  std::uint32_t lost() { return std::exchange(lost_frames, 0); }

 private:
  std::vector<can::Frame> batch_;
};

// Everything that sends to a controller.
class World {
 public:
  std::vector<can::Frame> frames_of(std::uint32_t tick) {
    std::vector<can::Frame> frames;
    if (tick % 50 == 0) {
      const auto number = static_cast<std::int32_t>(tick / 50 % 16);
      frames.push_back(can::send(can::VisionPose{.frame = number}, pose_));
      frames.push_back(can::send(can::VisionBall{.frame = number, .x_quarter_mm = 6000}, ball_));
    }
    frames.push_back(can::send(can::WheelState{}, wheels_));
    if (tick == 210) {
      frames.push_back(mode(can::Mode::arm));
    }
    if (confirmation_) {
      frames.push_back(*std::exchange(confirmation_, std::nullopt));
    }
    return frames;
  }
  can::Frame mode(can::Mode mode) { return operator_.command(mode); }

  // What the controller sent: a challenge is confirmed with the next frames.
  void hear(const std::vector<can::Frame>& sent) {
    const auto confirmation = operator_.answer(sent);
    confirmation_ = confirmation ? confirmation : confirmation_;
  }
  can::Frame sync(std::uint32_t tick) {
    return can::send(can::Sync{.tick = static_cast<std::int32_t>(tick)}, sync_);
  }

 private:
  can::SendCounter pose_, ball_, wheels_, sync_;
  BenchOperator operator_;
  std::optional<can::Frame> confirmation_;
};

inline bool has_torque(const std::vector<can::Frame>& frames) {
  for (const can::Frame& frame : frames) {
    can::WheelCommand command;
    if (can::is<can::WheelCommand>(frame) && can::unpack(frame, command) == can::Verdict::accepted &&
        (command.left_torque_mNm != 0 || command.right_torque_mNm != 0)) {
      return true;
    }
  }
  return false;
}

}  // namespace striker::loop

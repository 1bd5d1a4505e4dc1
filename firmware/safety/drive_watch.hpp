// SPDX-License-Identifier: Apache-2.0
// The gate's own account of drives of another make, which have no end-to-end protection: how old each wheel's speed is, and
// whether each drive told, not long ago, that it is enabled and has no error.
//
// What it cannot see: a frame that was sent before (a node that is stuck, a recording), two senders, a frame of a wrong
// sender, and wrong bits that a classic CAN frame's own CRC misses (firmware/can/README.md).
#pragma once

#include <array>
#include <cstdint>

#include "firmware/can/drives/drive_protocol.hpp"

namespace striker::safety {

class DriveWatch {
 public:
  // Before a tick's frames.
  void begin_tick() { wheels_[0].fell = wheels_[1].fell = false; }

  void take(const can::DriveNews& news, std::uint32_t received_tick) {
    Wheel& wheel = wheels_[news.wheel & 1U];
    if (news.verdict != can::Verdict::accepted) {
      return;  // an older one counts until it is too old
    }
    if (news.speed_mm_s) {
      wheel.has_speed = true;
      wheel.speed_tick = received_tick;
    }
    if (news.is_enabled) {
      wheel.is_enabled = *news.is_enabled;
      wheel.fell = wheel.fell || !wheel.is_enabled;
      wheel.told_tick = received_tick;
    }
  }

  [[nodiscard]] bool fresh(std::uint32_t tick, std::uint32_t limit_ticks) const {
    return both(
        [&](const Wheel& wheel) { return wheel.has_speed && tick - wheel.speed_tick <= limit_ticks; });
  }
  // Asked where torque is wanted.
  [[nodiscard]] bool enabled(std::uint32_t tick, std::uint32_t limit_ticks) const {
    return both([&](const Wheel& wheel) {
      return wheel.is_enabled && !wheel.fell && tick - wheel.told_tick <= limit_ticks;
    });
  }

 private:
  struct Wheel {
    std::uint32_t speed_tick = 0;
    std::uint32_t told_tick = 0;
    bool has_speed = false;
    bool is_enabled = false;
    bool fell = false;  // it told in this tick that it is not, whatever it told after
  };

  template <class Predicate>
  [[nodiscard]] bool both(Predicate holds) const {
    return holds(wheels_[0]) && holds(wheels_[1]);
  }

  std::array<Wheel, 2> wheels_{};
};

}  // namespace striker::safety

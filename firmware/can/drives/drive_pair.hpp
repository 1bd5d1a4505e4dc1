// SPDX-License-Identifier: Apache-2.0
// Two drives of another make as the two wheels of a robot: one pair of speeds from the frames of both, and faults of
// either. What their frames say is the protocol's business (DriveNews).
//
// Promise, with drives that tell their state every `state_period_ticks` (10 ms) at most: while the controller is active,
// a drive that tells of an error or is not enabled any more is the fault drives_cut, and one that is not heard any more is
// wheel_state_lost, within 3 of these periods, also if the same tick's next frame tells that it is enabled
// (tests/drives/drive_fault_test.cpp). One that does not come up within `settle_ticks` of being wanted is drives_cut too.
// Neither follows in the first `prepare_ticks` (8 ms). While it is not wanted, a drive may do as it likes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/core/state.hpp"

namespace striker::can {

inline constexpr std::uint32_t state_period_ticks = 10;

class DrivePair {
 public:
  // For DriveProtocol::take.
  [[nodiscard]] Verdict take(const DriveNews& news, std::uint32_t received_tick, DriveReport& report) {
    report.is_whole = false;
    is_invalid_ = news.verdict != Verdict::accepted;
    if (is_invalid_) {
      return news.verdict;
    }
    Wheel& wheel = wheels_[news.wheel];
    if (news.is_enabled) {
      wheel.told_tick = received_tick;
      wheel.is_enabled = *news.is_enabled;
      wheel.fell = wheel.fell || !wheel.is_enabled;
      wheel.rests = news.rests;
      wheel.was_enabled = wheel.was_enabled || (wheel.is_enabled && is_prepared(received_tick));
    }
    if (news.speed_mm_s) {
      wheel.speed_mm_s = *news.speed_mm_s;
      wheel.speed_tick = received_tick;
      wheel.has_speed = true;
      join(report);
    }
    return Verdict::accepted;
  }
  [[nodiscard]] bool invalid() const { return is_invalid_; }

  // Once a tick, after its frames.
  [[nodiscard]] core::Faults judge(std::uint32_t tick) {
    tick_ = tick;
    core::Faults faults = 0;
    for (Wheel& wheel : wheels_) {
      const bool should_be = wheel.was_enabled || tick - wanted_tick_ > settle_ticks;
      faults |= core::set_if(should_be && (!wheel.is_enabled || wheel.fell), core::Fault::drives_cut) |
                core::set_if(tick - wheel.told_tick > silence_ticks, core::Fault::wheel_state_lost);
      wheel.fell = false;
    }
    return is_wanted_ ? faults : 0;
  }

  // True when it begins or ends.
  bool enable(bool wanted) {
    const bool changes = wanted != is_wanted_;
    is_wanted_ = wanted;
    if (changes && wanted) {
      wanted_tick_ = tick_;
      for (Wheel& wheel : wheels_) {
        wheel.is_enabled = wheel.was_enabled = false;  // what it told before does not count
        wheel.told_tick = tick_;
      }
    }
    return changes;
  }
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }

  // Neither gets torque before both follow.
  [[nodiscard]] bool follows() const {
    return is_wanted_ && is_prepared(tick_) && wheels_[left_wheel].is_enabled &&
           wheels_[right_wheel].is_enabled;
  }
  [[nodiscard]] bool rests(std::size_t wheel) const { return wheels_[wheel].rests; }

 private:
  struct Wheel {
    std::uint32_t told_tick = 0;  // its state
    std::uint32_t speed_tick = 0;
    std::int32_t speed_mm_s = 0;
    bool has_speed = false;  // since the last pair
    bool is_enabled = false;
    bool was_enabled = false;  // since it is wanted
    bool fell = false;         // it told of an error or a stop in this tick, whatever it told after
    bool rests = true;
  };

  static constexpr std::uint32_t silence_ticks = 3 * state_period_ticks - 2;
  static constexpr std::uint32_t settle_ticks = 40;
  static constexpr std::uint32_t prepare_ticks = 8;  // whose first frames have gone out by then
  static constexpr std::uint32_t pair_ticks = 2;     // between two frames that belong together

  [[nodiscard]] bool is_prepared(std::uint32_t tick) const { return tick - wanted_tick_ >= prepare_ticks; }

  void join(DriveReport& report) {
    Wheel& left = wheels_[left_wheel];
    Wheel& right = wheels_[right_wheel];
    const std::uint32_t apart = left.speed_tick - right.speed_tick;
    if (left.has_speed && right.has_speed && (apart <= pair_ticks || 0U - apart <= pair_ticks)) {
      report.speeds = {left.speed_mm_s, right.speed_mm_s};
      report.is_whole = true;
      left.has_speed = right.has_speed = false;
    }
  }

  std::array<Wheel, 2> wheels_{};
  std::uint32_t tick_ = 0;
  std::uint32_t wanted_tick_ = 0;
  bool is_wanted_ = false;
  bool is_invalid_ = false;
};

}  // namespace striker::can

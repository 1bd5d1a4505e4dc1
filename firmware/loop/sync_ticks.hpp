// SPDX-License-Identifier: Apache-2.0
// Lockstep: ticks that a simulator gives, by Sync frames.
//
// Frames are kept until a valid Sync(t) ends the wait; then the controller steps once, at t, and its answer
// ends with EndOfTick(t). Sync(0) starts logical time anew, with a controller fresh from boot, so that one
// process serves one simulation after another with the same answers.
//
// Logical time rises, by at most `greatest_leap_ticks`. A Sync that stands still or goes back is ignored, so that a
// frame which came twice does no harm; several of them are the fault sync_invalid, as is a leap: time that does
// not pass, or two simulators.
//
// Only the port knows wall-clock time: it calls `overdue` when no Sync has come for its time-out, and again every
// 100 ms, and the next turn is a tick of its own, at the last tick's time, with the fault sync_lost. A bus that goes
// off does the same.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/can/bus_health.hpp"
#include "firmware/can/codec.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/loop/tick.hpp"

namespace striker::loop {

class SyncTicks {
 public:
  // A Sync has come at all.
  [[nodiscard]] bool running() const { return running_; }

  // No Sync has come for too long.
  void overdue() { overdue_ = running_; }

  template <class BusType>
  std::optional<Tick> next(BusType& bus) {
    for (auto received = bus.receive(1); !received.frames.empty(); received = bus.receive(1)) {
      if (const auto tick = take(received.frames.front())) {
        return tick;
      }
    }
    return port_tick(bus.health());
  }

  void end(can::FrameList& sent) {
    if (answers_sync_) {
      count_ = 0;  // a tick of the port's own took none of them
      lost_ = 0;
      sent.add(
          can::send(can::EndOfTick{.tick = static_cast<std::int32_t>(tick_ & low_31_bits)}, end_counter_));
    }
  }

  void done() {}

  // The last tick was a Sync, not the port's own.
  [[nodiscard]] bool answered_sync() const { return answers_sync_; }

 private:
  static constexpr std::uint32_t low_31_bits = 0x7FFFFFFF;

  // More than any bus brings in a tick. Beyond it frames are lost and counted; an emergency stop is not.
  static constexpr std::size_t most_frames = 32;

  static constexpr std::uint32_t greatest_leap_ticks = 1'000;

  // Errors weigh four times what a good Sync takes back.
  static constexpr std::uint32_t error_weight = 4;
  static constexpr std::uint32_t error_limit = 3 * error_weight;

  // The tick that this frame ends the wait for, if it is a Sync.
  std::optional<Tick> take(const can::Frame& frame) {
    if (!can::is<can::Sync>(frame)) {
      keep(frame);
      return std::nullopt;
    }
    can::Sync sync;
    if (can::receive(frame, sync) != can::Verdict::accepted) {
      return ignore();
    }
    if (sync.tick == 0) {
      forget_all_but_stop();
      return begin(0, {.restart = true});
    }
    // The wire carries 31 bits of the tick: the difference carries it over the wrap.
    const std::uint32_t ahead = (static_cast<std::uint32_t>(sync.tick) - tick_) & low_31_bits;
    if (running_ && (ahead == 0 || ahead > low_31_bits / 2)) {
      return ignore();
    }
    const bool leaps = running_ && ahead > greatest_leap_ticks;
    errors_ -= errors_ == 0 ? 0 : 1;
    return begin(ahead, {.port_faults = core::set_if(leaps, core::Fault::sync_invalid)});
  }

  void keep(const can::Frame& frame) {
    if (count_ < most_frames) {
      frames_[count_++] = frame;
    } else {
      ++lost_;
      if (can::is_valid<can::EmergencyStop>(frame)) {
        frames_.back() = frame;
      }
    }
  }

  void forget_all_but_stop() {
    const auto kept = std::span(frames_).first(count_);
    const auto stop = std::find_if(kept.begin(), kept.end(), can::is_valid<can::EmergencyStop>);
    const auto pressed = stop == kept.end() ? std::nullopt : std::optional(*stop);
    *this = {};
    if (pressed) {
      keep(*pressed);
    }
  }

  std::optional<Tick> ignore() {
    errors_ += error_weight;
    if (errors_ < error_limit) {
      return std::nullopt;
    }
    errors_ = 0;
    answers_sync_ = false;
    return Tick{.number = tick_, .port_faults = core::set_of(core::Fault::sync_invalid)};
  }

  Tick begin(std::uint32_t ahead, Tick tick) {
    running_ = true;
    tick_ += ahead;
    answers_sync_ = true;
    told_overdue_ = false;
    overdue_ = false;
    tick.number = tick_;
    tick.frames = std::span(frames_).first(count_);
    tick.lost_frames = lost_;
    return tick;
  }

  std::optional<Tick> port_tick(can::BusHealth health) {
    const bool went_off = health == can::BusHealth::bus_off && health_ != can::BusHealth::bus_off;
    health_ = health;
    if (!overdue_ && !went_off) {
      return std::nullopt;
    }
    answers_sync_ = false;
    const core::Fault fault = overdue_ ? core::Fault::sync_lost : core::Fault::bus_off;
    const bool again = overdue_ && told_overdue_;
    told_overdue_ = told_overdue_ || overdue_;
    overdue_ = false;
    return Tick{.number = tick_, .port_faults = core::set_of(fault), .repeat_fault = again};
  }

  can::SendCounter end_counter_;
  std::uint32_t tick_ = 0;
  std::uint32_t errors_ = 0;
  std::uint32_t lost_ = 0;
  bool running_ = false;
  bool answers_sync_ = false;
  bool overdue_ = false;
  bool told_overdue_ = false;
  can::BusHealth health_ = can::BusHealth::active;
  std::array<can::Frame, most_frames> frames_{};
  std::size_t count_ = 0;
};

}  // namespace striker::loop

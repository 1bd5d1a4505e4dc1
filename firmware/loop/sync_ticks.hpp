// SPDX-License-Identifier: Apache-2.0
// Lockstep: ticks that a simulator gives, by Sync frames.
//
// Frames are kept until a valid Sync(t) ends the wait; then the controller steps once, at t, and its answer
// ends with EndOfTick(t). Sync(0) starts logical time anew, with a controller fresh from boot, so that one
// process serves one simulation after another with the same answers.
//
// Only the port knows wall-clock time: it calls `overdue` when no Sync has come for its time-out, and the next
// turn is a tick of its own, at the last tick's time, with the fault sync_lost. A bus that goes off does the
// same.
#pragma once

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
  [[nodiscard]] bool running() const { return counter_.seen; }

  // No Sync has come for too long: once until the next one.
  void overdue() { overdue_ = running() && !told_overdue_; }

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
      sent.add(
          can::send(can::EndOfTick{.tick = static_cast<std::int32_t>(tick_ & low_31_bits)}, end_counter_));
    }
  }

  void done() {}

  // The last tick was a Sync, not the port's own.
  [[nodiscard]] bool answered_sync() const { return answers_sync_; }

 private:
  static constexpr std::uint32_t low_31_bits = 0x7FFFFFFF;

  // More than any tick brings; beyond it frames are dropped, and the receive checks notice the gap.
  static constexpr std::size_t most_frames = 32;

  // The tick that this frame ends the wait for, if it is a Sync.
  std::optional<Tick> take(const can::Frame& frame) {
    if (!can::is<can::Sync>(frame)) {
      if (count_ < most_frames) {
        frames_[count_++] = frame;
      }
      return std::nullopt;
    }
    can::Sync sync;
    can::ReceiveCounter anew;
    const bool restart = can::receive(frame, anew, sync) == can::Verdict::accepted && sync.tick == 0;
    if (restart) {
      *this = {};
      counter_ = anew;
    } else if (can::receive(frame, counter_, sync) != can::Verdict::accepted) {
      return std::nullopt;
    }
    // The wire carries 31 bits of the tick: the difference carries it over the wrap.
    tick_ += (static_cast<std::uint32_t>(sync.tick) - tick_) & low_31_bits;
    answers_sync_ = true;
    told_overdue_ = false;
    overdue_ = false;
    return Tick{.number = tick_, .frames = std::span(frames_).first(count_), .restart = restart};
  }

  std::optional<Tick> port_tick(can::BusHealth health) {
    const bool went_off = health == can::BusHealth::bus_off && health_ != can::BusHealth::bus_off;
    health_ = health;
    if (!overdue_ && !went_off) {
      return std::nullopt;
    }
    answers_sync_ = false;
    told_overdue_ = told_overdue_ || overdue_;
    const core::Fault fault = overdue_ ? core::Fault::sync_lost : core::Fault::bus_off;
    overdue_ = false;
    return Tick{.number = tick_, .frames = {}, .port_fault = fault};
  }

  can::ReceiveCounter counter_;
  can::SendCounter end_counter_;
  std::uint32_t tick_ = 0;
  bool answers_sync_ = false;
  bool overdue_ = false;
  bool told_overdue_ = false;
  can::BusHealth health_ = can::BusHealth::active;
  std::array<can::Frame, most_frames> frames_{};
  std::size_t count_ = 0;
};

}  // namespace striker::loop

// SPDX-License-Identifier: Apache-2.0
// Ticks by the port's own clock: hard real time.
//
// A tick waits for its absolute deadline and receives at most `frames_per_tick` frames; more wait for the
// next, so that a flooded bus does not stretch it. Whole ticks that were missed are skipped and counted, never
// run in a burst; more than `overrun_limit` of the last 1,000 are the fault overrun, as long as they are.
//
// It allocates nothing, takes no lock, and calls nothing but clock and bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include "firmware/loop/bus.hpp"
#include "firmware/loop/clock.hpp"
#include "firmware/loop/overrun_limit.hpp"
#include "firmware/loop/tick.hpp"
#include "firmware/loop/timing_window.hpp"

namespace striker::loop {

struct ClockTicksOptions {
  std::uint32_t frames_per_tick;
  std::uint32_t overrun_limit;  // missed ticks within 1,000
};

// What the last tick was like.
template <class Time>
struct TickMeasurement {
  Wake<Time> wake;
  Time execution = 0;                // receive, step, send
  std::optional<Time> latency = {};  // from its oldest frame's reception to its commands sent
  std::size_t received = 0;
  bool full = false;  // it took as many frames as a tick may
};

template <Clock ClockType>
class ClockTicks {
 public:
  using Time = typename ClockType::Time;

  constexpr ClockTicks(ClockType& clock, const ClockTicksOptions& options)
      : clock_(&clock), frames_per_tick_(options.frames_per_tick), limit_(options.overrun_limit) {}

  template <Bus<Time> BusType>
  std::optional<Tick> next(BusType& bus) {
    if (!begun_) {
      begun_ = true;
      end_ = clock_->now();
    }
    last_ = {.wake = clock_->wait([&bus] { bus.poll(); })};
    begin_ = clock_->now();
    const bool overrun = limit_.exceeded_by(last_.wake.missed);
    window_.take_lateness_us(ClockType::to_us(last_.wake.lateness));
    window_.take_missed(last_.wake.missed);
    const Received<Time> received = bus.receive(frames_per_tick_);
    oldest_ = received.oldest;
    last_.received = received.frames.size();
    last_.full = last_.received >= frames_per_tick_;
    return Tick{.number = last_.wake.tick,
                .frames = received.frames,
                .timing = window_.message(),
                .port_faults = core::set_if(overrun, core::Fault::overrun)};
  }

  void end(const can::FrameList& sent) { window_.restart_if_among(sent); }

  void done() {
    const Time end = clock_->now();
    const Time passed = since(end_, end);
    run_ = passed < 0 || passed > greatest - run_ ? greatest : run_ + passed;
    end_ = end;
    last_.execution = since(begin_, end);
    window_.take_execution_us(ClockType::to_us(last_.execution));
    // Frames from before the loop began say nothing about its latency.
    if (last_.received > 0 && is_within_run(since(oldest_, end))) {
      last_.latency = since(oldest_, end);
      window_.take_latency_us(ClockType::to_us(*last_.latency));
    }
  }

  [[nodiscard]] const TickMeasurement<Time>& last() const { return last_; }

 private:
  static constexpr Time greatest = std::numeric_limits<Time>::max();

  // Time wraps, and so does its difference; on signed integers that is undefined.
  static constexpr Time since(Time earlier, Time later) {
    using Bits = std::make_unsigned_t<Time>;
    return static_cast<Time>(static_cast<Bits>(later) - static_cast<Bits>(earlier));
  }
  [[nodiscard]] bool is_within_run(Time age) const { return age >= 0 && age <= run_; }

  ClockType* clock_;
  std::uint32_t frames_per_tick_;
  OverrunLimit limit_;
  TimingWindow window_;
  bool begun_ = false;
  Time end_ = 0;  // of the last tick
  Time run_ = 0;  // since the first tick was waited for; stays at the greatest
  Time begin_ = 0;
  Time oldest_ = 0;
  TickMeasurement<Time> last_;
};

}  // namespace striker::loop

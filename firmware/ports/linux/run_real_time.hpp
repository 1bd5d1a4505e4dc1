// SPDX-License-Identifier: Apache-2.0
// Runs a controller on the port's own 1 ms clock, until a stop signal, and measures it.
//
// A tick waits for its absolute deadline, receives at most `frames_per_tick` frames (more wait for the next),
// steps, sends, and measures. Between the first deadline and the last it allocates nothing, takes no lock, and
// calls the kernel for nothing but
//
//   clock_nanosleep      once a tick
//   recvmsg              once a tick on the socket of emergency stops, and once more for each of them
//   recvmmsg, sendmmsg   once a tick on a CAN socket; sendmmsg once more for every frame that is dropped
//
// (and clock_gettime, where the machine has no vDSO for it). The rules of the loop itself, overruns among
// them, are firmware/loop's.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "firmware/host/periodic_clock.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/clock_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/linux/frame_batch.hpp"
#include "firmware/ports/linux/loop_timing.hpp"

namespace striker::linux_port {

struct RealTimeOptions {
  std::int64_t period_ns = loop::tick_period_ns;  // of the loop; the controller takes each for 1 ms
  std::uint32_t overrun_limit = 500;
  std::uint32_t frames_per_tick = 64;  // up to greatest_frames_per_tick
  std::uint64_t ticks = 0;             // stops after these; 0: a stop signal alone stops
  std::uint32_t challenge_seed = 0;    // core/supervision/consent.hpp
};

// The loop's clock: CLOCK_MONOTONIC, or a test's.
class LoopClock {
 public:
  using Time = std::int64_t;  // ns

  LoopClock(host::AbsoluteClock& clock, std::int64_t period_ns)
      : clock_(&clock), deadlines_(clock, period_ns) {}

  template <class Idle>
  loop::Wake<Time> wait(Idle) {
    const auto [tick, lateness_ns, missed] = deadlines_.wait();
    return {.tick = tick, .missed = missed, .lateness = lateness_ns};
  }
  [[nodiscard]] Time now() { return clock_->now_ns(); }
  [[nodiscard]] static std::int32_t to_us(Time ns) {
    constexpr Time greatest_us = 1'000'000'000;
    return static_cast<std::int32_t>(std::clamp<Time>(ns / 1000, 0, greatest_us));
  }

 private:
  host::AbsoluteClock* clock_;
  host::PeriodicClock deadlines_;
};

inline void note(LoopTiming& timing, const loop::TickMeasurement<std::int64_t>& tick) {
  ++timing.ticks;
  timing.missed_periods += tick.wake.missed;
  timing.longest_stall_periods = std::max(timing.longest_stall_periods, tick.wake.missed);
  timing.lateness.add(tick.wake.lateness, tick.wake.tick);
  timing.execution.add(tick.execution, tick.wake.tick);
  timing.received_frames += tick.received;
  timing.full_ticks += tick.full ? 1 : 0;
  if (tick.latency) {
    timing.latency.add(*tick.latency, tick.wake.tick);
  }
}

// `fault` follows the controller's, for another thread to tell.
template <loop::Bus<std::int64_t> BusType>
void run_real_time(BusType& bus, host::AbsoluteClock& clock, const RealTimeOptions& options,
                   LoopTiming& timing, std::atomic<core::Fault>& fault) {
  using Ticks = loop::ClockTicks<LoopClock>;
  LoopClock loop_clock(clock, options.period_ns);
  Ticks ticks(loop_clock,
              {.frames_per_tick = options.frames_per_tick, .overrun_limit = options.overrun_limit});
  loop::TickLoop<loop::BuiltInNode, BusType&, Ticks&> loop(loop::built_in_robot, bus, ticks,
                                                           options.challenge_seed);
  const ResourceUse before = thread_resource_use();
  while (!host::stop_requested() && (options.ticks == 0 || timing.ticks < options.ticks)) {
    loop.turn();
    note(timing, ticks.last());
    const core::Fault now = loop.node().controller().fault();
    timing.fault = now != core::Fault::none ? now : timing.fault;
    fault.store(now, std::memory_order_relaxed);
  }
  timing.resources = thread_resource_use() - before;
  loop.stop();
  timing.dropped_frames = loop.dropped_frames();
}

}  // namespace striker::linux_port

#include <algorithm>
#include <array>
#include <span>

#include "firmware/core/controller.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/ports/linux/executor.hpp"
#include "firmware/ports/linux/overrun_limit.hpp"

namespace striker::linux_port {

namespace {

// The frames of one tick. A flooded bus must not stretch it: what does not fit waits for the next.
class TickFrames {
 public:
  explicit TickFrames(std::uint32_t limit) : limit_(std::min(limit, greatest_frames_per_tick)) {}

  void take(FrameBus& bus) {
    count_ = bus.receive(std::span(stamped_).first(limit_));
    for (std::size_t i = 0; i < count_; ++i) {
      frames_[i] = stamped_[i].frame;
    }
  }

  [[nodiscard]] std::span<const can::Frame> frames() const { return std::span(frames_).first(count_); }
  [[nodiscard]] bool full() const { return count_ == limit_; }
  // Of those that were taken.
  [[nodiscard]] std::int64_t oldest_ns() const { return stamped_.front().received_ns; }

 private:
  std::size_t limit_;
  std::size_t count_ = 0;
  std::array<StampedFrame, greatest_frames_per_tick> stamped_{};
  std::array<can::Frame, greatest_frames_per_tick> frames_{};
};

// The measured fields of the timing frame: maxima since the last one that was sent.
class TimingWindow {
 public:
  void take_lateness(std::int64_t ns) { lateness_us_ = std::max(lateness_us_, ns / 1000); }
  void take_execution(std::int64_t ns) { execution_us_ = std::max(execution_us_, ns / 1000); }
  void take_latency(std::int64_t ns) { latency_us_ = std::max(latency_us_, ns / 1000); }

  [[nodiscard]] can::Timing frame(std::uint64_t missed) const {
    return {.lateness_max_us = field(lateness_us_),
            .execution_max_us = field(execution_us_),
            .overruns = field(static_cast<std::int64_t>(missed)),
            .latency_max_us = field(latency_us_)};
  }

  void restart_if_sent(const core::Outputs& outputs) {
    for (const can::Frame& frame : outputs.frames()) {
      if (can::is<can::Timing>(frame)) {
        *this = {};
      }
    }
  }

 private:
  static std::int32_t field(std::int64_t value) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, 0, can::not_available - 1));
  }

  std::int64_t lateness_us_ = 0;
  std::int64_t execution_us_ = 0;
  std::int64_t latency_us_ = 0;
};

class RealTimeLoop {
 public:
  RealTimeLoop(FrameBus& bus, host::LoopClock& clock, const RealTimeOptions& options, LoopTiming& timing)
      : bus_(bus),
        clock_(clock),
        timing_(timing),
        begin_ns_(clock.now_ns()),
        frames_(options.frames_per_tick),
        limit_(options.overrun_limit) {}

  [[nodiscard]] can::Fault fault() const { return controller_.fault(); }

  void tick(const host::PeriodicClock::Wake& wake) {
    const std::int64_t start_ns = clock_.now_ns();
    note_wake(wake);
    frames_.take(bus_);
    controller_.step(
        {.tick = wake.tick, .frames = frames_.frames(), .timing = window_.frame(timing_.missed_periods)},
        outputs_);
    window_.restart_if_sent(outputs_);
    enter_port_faults(wake);
    timing_.dropped_frames += bus_.send(outputs_.frames());
    note_end(wake.tick, start_ns, clock_.now_ns());
  }

  void stop() {
    controller_.disarm(outputs_);
    timing_.dropped_frames += bus_.send(outputs_.frames());
  }

 private:
  void note_wake(const host::PeriodicClock::Wake& wake) {
    ++timing_.ticks;
    timing_.missed_periods += wake.missed;
    timing_.longest_stall_periods = std::max(timing_.longest_stall_periods, wake.missed);
    timing_.lateness.add(wake.lateness_ns, wake.tick);
    window_.take_lateness(wake.lateness_ns);
  }

  // Once a fault: while it is latched, the controller reports it by itself.
  void enter_port_faults(const host::PeriodicClock::Wake& wake) {
    const bool overrun = limit_.exceeded_by(wake.tick, wake.missed);
    const bool bus_off = bus_.take_bus_off();
    if ((overrun || bus_off) && controller_.state() != can::State::fault) {
      controller_.enter_fault(overrun ? can::Fault::overrun : can::Fault::bus_off, outputs_);
    }
    timing_.fault = controller_.fault() != can::Fault::none ? controller_.fault() : timing_.fault;
  }

  void note_end(std::uint32_t tick, std::int64_t start_ns, std::int64_t end_ns) {
    timing_.received_frames += frames_.frames().size();
    timing_.full_ticks += frames_.full() ? 1 : 0;
    timing_.execution.add(end_ns - start_ns, tick);
    window_.take_execution(end_ns - start_ns);
    if (!frames_.frames().empty() && frames_.oldest_ns() >= begin_ns_) {
      timing_.latency.add(end_ns - frames_.oldest_ns(), tick);
      window_.take_latency(end_ns - frames_.oldest_ns());
    }
  }

  FrameBus& bus_;
  host::LoopClock& clock_;
  LoopTiming& timing_;
  std::int64_t begin_ns_;  // frames from before say nothing about the latency
  core::Controller controller_;
  core::Outputs outputs_;
  TickFrames frames_;
  TimingWindow window_;
  OverrunLimit limit_;
};

}  // namespace

void run_real_time(FrameBus& bus, host::LoopClock& clock, const RealTimeOptions& options, LoopTiming& timing,
                   std::atomic<can::Fault>& fault) {
  RealTimeLoop loop(bus, clock, options, timing);
  host::PeriodicClock deadlines(clock, options.period_ns);
  const ResourceUse before = thread_resource_use();
  while (!host::stop_requested() && (options.ticks == 0 || timing.ticks < options.ticks)) {
    loop.tick(deadlines.wait());
    fault.store(loop.fault(), std::memory_order_relaxed);
  }
  timing.resources = thread_resource_use() - before;
  loop.stop();
}

}  // namespace striker::linux_port

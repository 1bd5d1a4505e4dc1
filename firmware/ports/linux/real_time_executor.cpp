#include <algorithm>
#include <array>

#include "core/controller.hpp"
#include "ports/linux/executor.hpp"
#include "ports/linux/outbox.hpp"
#include "ports/linux/real_time.hpp"
#include "ports/linux/stop_signal.hpp"

namespace striker::linux_port {

namespace {

// A flooded bus must not stretch a tick: what does not fit waits in the socket for the next.
constexpr std::size_t frames_per_tick = 64;

constexpr std::uint32_t overrun_window_ticks = 1000;

std::span<const can::Frame> take_frames(CanSocket& socket, std::array<can::Frame, frames_per_tick>& storage) {
  std::size_t count = 0;
  while (count < storage.size()) {
    const auto frame = socket.receive();
    if (!frame) {
      break;
    }
    storage[count++] = *frame;
  }
  return std::span(storage).first(count);
}

// The measured fields of the timing frame: maxima since the last one that was sent.
class TimingWindow {
 public:
  void take_lateness(std::int64_t ns) { lateness_us_ = std::max(lateness_us_, ns / 1000); }
  void take_execution(std::int64_t ns) { execution_us_ = std::max(execution_us_, ns / 1000); }

  [[nodiscard]] can::Timing frame(std::uint64_t missed) const {
    constexpr std::int64_t greatest = can::not_available - 1;
    return {.lateness_max_us = static_cast<std::int32_t>(std::min(lateness_us_, greatest)),
            .execution_max_us = static_cast<std::int32_t>(std::min(execution_us_, greatest)),
            .overruns = static_cast<std::int32_t>(std::min<std::uint64_t>(missed, greatest))};
  }

  void restart_if_sent(const core::Outputs& outputs) {
    for (const can::Frame& frame : outputs.frames()) {
      if (can::is<can::Timing>(frame)) {
        *this = {};
      }
    }
  }

 private:
  std::int64_t lateness_us_ = 0;
  std::int64_t execution_us_ = 0;
};

class OverrunLimit {
 public:
  explicit OverrunLimit(std::uint32_t limit) : limit_(limit) {}

  bool exceeded_by(const PeriodicClock::Wake& wake) {
    if (wake.tick - window_start_ >= overrun_window_ticks) {
      window_start_ = wake.tick;
      missed_ = 0;
    }
    missed_ += wake.missed;
    return missed_ > limit_;
  }

 private:
  std::uint32_t limit_;
  std::uint32_t window_start_ = 0;
  std::uint32_t missed_ = 0;
};

}  // namespace

RealTimeReport run_real_time(CanSocket& socket, std::uint32_t overrun_limit) {
  RealTimeReport report;
  core::Controller controller;
  core::Outputs outputs;
  std::array<can::Frame, frames_per_tick> storage{};
  TimingWindow timing;
  OverrunLimit overruns(overrun_limit);
  FaultAnnouncer announcer;
  PeriodicClock clock;
  while (!stop_requested()) {
    const PeriodicClock::Wake wake = clock.wait();
    ++report.ticks;
    report.missed_periods += wake.missed;
    report.lateness_max_ns = std::max(report.lateness_max_ns, wake.lateness_ns);
    report.lateness_sum_ns += wake.lateness_ns;
    timing.take_lateness(wake.lateness_ns);

    const std::int64_t start_ns = monotonic_ns();
    const auto frames = take_frames(socket, storage);
    controller.step({.tick = wake.tick, .frames = frames, .timing = timing.frame(report.missed_periods)},
                    outputs);
    timing.restart_if_sent(outputs);
    if (overruns.exceeded_by(wake)) {
      controller.enter_fault(can::Fault::overrun, outputs);
    } else if (socket.take_bus_off()) {
      controller.enter_fault(can::Fault::bus_off, outputs);
    }
    report.dropped_frames += send_all(socket, outputs);
    const std::int64_t execution_ns = monotonic_ns() - start_ns;
    timing.take_execution(execution_ns);
    report.execution_max_ns = std::max(report.execution_max_ns, execution_ns);
    announcer.announce(controller);
  }
  controller.disarm(outputs);
  report.dropped_frames += send_all(socket, outputs);
  return report;
}

}  // namespace striker::linux_port

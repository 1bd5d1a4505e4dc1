// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/run_lockstep.hpp"

#include <fmt/core.h>

#include <span>
#include <utility>

#include "firmware/host/stop_signal.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/linux/fault_announcer.hpp"

namespace striker::linux_port {

namespace {

// A stop waits on the other socket for this long at most.
constexpr std::chrono::milliseconds wait_limit{2};
constexpr std::chrono::milliseconds fault_report_period{can::layout<can::FaultReport>.info.period_ms};

constexpr std::chrono::milliseconds patience{500};  // with a queue that is full

// Two sockets as the loop's bus, a frame at a time, stops before all others. In lockstep nothing is measured, and a
// frame is as old as the logical time says.
class LockstepBus {
 public:
  LockstepBus(host::CanSocket& socket, host::CanSocket& stops) : socket_(&socket), stops_(&stops) {}

  void poll() {}
  loop::Received<std::int64_t> receive(std::size_t) {
    auto frame = stops_->receive();
    if (!frame) {
      frame = socket_->receive();
    }
    frame_ = frame.value_or(can::Frame{});
    frame_.age_ms = 0;
    return {.frames = std::span(&frame_, frame ? 1 : 0)};
  }
  // A full queue gets time, once for all of a tick's frames: in lockstep the peer waits for them.
  std::size_t try_send(std::span<const can::Frame> frames) {
    std::size_t taken = 0;
    bool was_taken = true;
    for (const can::Frame& frame : frames) {
      was_taken = was_taken ? socket_->send(frame, patience) : socket_->send(frame);
      taken += was_taken ? 1 : 0;
    }
    if (taken < frames.size()) {
      tell_full_queue();
    }
    return taken;
  }
  [[nodiscard]] can::BusHealth health() { return socket_->health(); }
  [[nodiscard]] std::uint32_t lost() { return socket_->lost(); }

 private:
  void tell_full_queue() {
    if (!std::exchange(told_, true)) {
      fmt::print(stderr, "striker-firmware: {}: frames are dropped\n", socket_->full_queue(patience));
    }
  }

  host::CanSocket* socket_;
  host::CanSocket* stops_;
  can::Frame frame_;
  bool told_ = false;
};

static_assert(loop::Bus<LockstepBus, std::int64_t>);

}  // namespace

template <class Node>
LockstepReport run_lockstep(const core::RobotProfile& robot, const LockstepSockets& sockets,
                            std::chrono::milliseconds sync_timeout, std::uint32_t seed) {
  using Clock = std::chrono::steady_clock;
  LockstepReport report;
  LockstepBus bus(sockets.all_but_stops, sockets.stops);
  loop::SyncTicks ticks;
  loop::TickLoop<Node, LockstepBus&, loop::SyncTicks&> loop(robot, bus, ticks, seed);
  FaultAnnouncer announcer;
  auto last_sync = Clock::now();
  auto last_told = last_sync;
  while (!host::stop_requested()) {
    while (loop.turn()) {
      report.ticks += ticks.answered_sync() ? 1 : 0;
      last_sync = ticks.answered_sync() ? Clock::now() : last_sync;
    }
    const auto now = Clock::now();
    if (now - last_sync > sync_timeout && now - last_told > fault_report_period) {
      last_told = now;
      ticks.overdue();
      loop.turn();  // the fault, or a Sync that came just now
      last_sync = ticks.answered_sync() ? Clock::now() : last_sync;
    }
    announcer.announce(loop.node().controller().fault());
    sockets.all_but_stops.wait(wait_limit);
  }
  loop.stop();
  report.dropped_frames = loop.dropped_frames();
  return report;
}

template LockstepReport run_lockstep<loop::BuiltInNode>(const core::RobotProfile&, const LockstepSockets&,
                                                        std::chrono::milliseconds, std::uint32_t);
template LockstepReport run_lockstep<loop::OrderedNode>(const core::RobotProfile&, const LockstepSockets&,
                                                        std::chrono::milliseconds, std::uint32_t);

}  // namespace striker::linux_port

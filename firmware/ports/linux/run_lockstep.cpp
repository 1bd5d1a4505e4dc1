// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/run_lockstep.hpp"

#include <span>

#include "firmware/host/stop_signal.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/bus.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/ports/linux/fault_announcer.hpp"

namespace striker::linux_port {

namespace {

constexpr std::chrono::milliseconds wait_limit{20};

// A socket as the loop's bus, a frame at a time; in lockstep nothing is measured.
class LockstepBus {
 public:
  explicit LockstepBus(host::CanSocket& socket) : socket_(&socket) {}

  void poll() {}
  loop::Received<std::int64_t> receive(std::size_t) {
    const auto frame = socket_->receive();
    frame_ = frame.value_or(can::Frame{});
    return {.frames = std::span(&frame_, frame ? 1 : 0)};
  }
  std::size_t try_send(std::span<const can::Frame> frames) {
    std::size_t taken = 0;
    for (const can::Frame& frame : frames) {
      taken += socket_->send(frame) ? 1 : 0;
    }
    return taken;
  }
  [[nodiscard]] can::BusHealth health() { return socket_->health(); }

 private:
  host::CanSocket* socket_;
  can::Frame frame_;
};

static_assert(loop::Bus<LockstepBus, std::int64_t>);

}  // namespace

LockstepReport run_lockstep(host::CanSocket& socket, std::chrono::milliseconds sync_timeout) {
  using Clock = std::chrono::steady_clock;
  LockstepReport report;
  LockstepBus bus(socket);
  loop::SyncTicks ticks;
  loop::TickLoop<loop::BuiltInNode, LockstepBus&, loop::SyncTicks&> loop(loop::built_in_robot, bus, ticks);
  FaultAnnouncer announcer;
  auto last_sync = Clock::now();
  while (!host::stop_requested()) {
    while (loop.turn()) {
      report.ticks += ticks.answered_sync() ? 1 : 0;
      last_sync = ticks.answered_sync() ? Clock::now() : last_sync;
    }
    if (Clock::now() - last_sync > sync_timeout) {
      ticks.overdue();
      loop.turn();  // the fault, or a Sync that came just now
      last_sync = ticks.answered_sync() ? Clock::now() : last_sync;
    }
    announcer.announce(loop.node().controller().fault());
    socket.wait(wait_limit);
  }
  loop.stop();
  report.dropped_frames = loop.dropped_frames();
  return report;
}

}  // namespace striker::linux_port

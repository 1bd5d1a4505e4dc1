#include "firmware/core/sync_clock.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/ports/linux/executor.hpp"
#include "firmware/ports/linux/outbox.hpp"

namespace striker::linux_port {

LockstepReport run_lockstep(host::CanSocket& socket, std::chrono::milliseconds sync_timeout) {
  LockstepReport report;
  core::SyncClock clock;
  core::Outputs outputs;
  FaultAnnouncer announcer;
  bool sync_lost = false;
  auto last_sync = std::chrono::steady_clock::now();
  while (!host::stop_requested()) {
    while (const auto frame = socket.receive()) {
      if (clock.take(*frame, outputs)) {
        report.dropped_frames += send_all(socket, outputs);
        ++report.ticks;
        last_sync = std::chrono::steady_clock::now();
        sync_lost = false;
      }
    }
    if (socket.take_bus_off()) {
      clock.controller().enter_fault(can::Fault::bus_off, outputs);
      report.dropped_frames += send_all(socket, outputs);
    }
    const bool overdue = std::chrono::steady_clock::now() - last_sync > sync_timeout;
    if (clock.running() && overdue && !sync_lost) {
      sync_lost = true;
      clock.controller().enter_fault(can::Fault::sync_lost, outputs);
      report.dropped_frames += send_all(socket, outputs);
    }
    announcer.announce(clock.controller().fault());
    socket.wait(std::chrono::milliseconds(20));
  }
  clock.controller().disarm(outputs);
  report.dropped_frames += send_all(socket, outputs);
  return report;
}

}  // namespace striker::linux_port

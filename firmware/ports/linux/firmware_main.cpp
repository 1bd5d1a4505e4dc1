// striker-firmware: the kick controller as a Linux process on a CAN interface.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>

#include "ports/linux/executor.hpp"
#include "ports/linux/real_time.hpp"
#include "ports/linux/stop_signal.hpp"

namespace {

using namespace striker::linux_port;

struct Options {
  std::string can;
  std::string clock = "sync";
  unsigned sync_timeout_ms = 2000;
  unsigned overrun_limit = 500;
  int priority = 80;
};

void define(CLI::App& app, Options& options) {
  app.add_option("--can", options.can, "CAN interface, for example vcan0")->required();
  app.add_option("--clock", options.clock, "what ticks the controller")
      ->check(CLI::IsMember({"sync", "realtime"}))
      ->capture_default_str();
  app.add_option("--sync-timeout", options.sync_timeout_ms, "sync: fault without a SYNC for this long, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  app.add_option("--overrun-limit", options.overrun_limit,
                 "realtime: fault beyond this many missed periods within 1,000")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--priority", options.priority, "SCHED_FIFO priority, where permitted")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
}

void run_on_sync(CanSocket& socket, const Options& options) {
  const LockstepReport report = run_lockstep(socket, std::chrono::milliseconds(options.sync_timeout_ms));
  fmt::print("striker-firmware: stopped after {} ticks; {} frames dropped\n", report.ticks,
             report.dropped_frames);
}

void run_on_own_clock(CanSocket& socket, const Options& options) {
  const RealTimeReport report = run_real_time(socket, options.overrun_limit);
  const double ticks = static_cast<double>(report.ticks == 0 ? 1 : report.ticks);
  fmt::print(
      "striker-firmware: stopped after {} ticks; {} periods missed; lateness mean {:.1f} us, max {:.1f} us; "
      "execution max {:.1f} us; {} frames dropped\n",
      report.ticks, report.missed_periods, static_cast<double>(report.lateness_sum_ns) / ticks / 1e3,
      static_cast<double>(report.lateness_max_ns) / 1e3, static_cast<double>(report.execution_max_ns) / 1e3,
      report.dropped_frames);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The kick controller on a CAN interface. Stops cleanly on SIGINT or SIGTERM, with torque 0 sent.",
      "striker-firmware");
  Options options;
  define(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    catch_stop_signals();
    CanSocket socket(options.can, controller_receives);
    const std::string refused = ask_for_real_time(options.priority);
    if (!refused.empty()) {
      fmt::print(stderr,
                 "striker-firmware: {}: timing is best effort; run as root or grant CAP_SYS_NICE and "
                 "CAP_IPC_LOCK\n",
                 refused);
    }
    fmt::print("striker-firmware: on {}, clock {}\n", options.can, options.clock);
    std::fflush(stdout);
    options.clock == "sync" ? run_on_sync(socket, options) : run_on_own_clock(socket, options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "striker-firmware: {}\n", error.what());
    return 2;
  }
}

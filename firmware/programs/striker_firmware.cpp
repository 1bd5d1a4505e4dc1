// SPDX-License-Identifier: Apache-2.0
// striker-firmware: the kick controller as a Linux process, on a CAN interface or on a bench in the process.
#include <fmt/core.h>
#include <sys/random.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/can/controller_receives.hpp"
#include "firmware/host/can/interface_watch.hpp"
#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/loop/built_in_robot.hpp"
#include "firmware/policy/built_in.hpp"
#include "firmware/ports/linux/bench_peer.hpp"
#include "firmware/ports/linux/fault_announcer.hpp"
#include "firmware/ports/linux/real_time.hpp"
#include "firmware/ports/linux/real_time_socket.hpp"
#include "firmware/ports/linux/run_lockstep.hpp"
#include "firmware/ports/linux/run_real_time.hpp"
#include "firmware/ports/linux/stop_identifiers.hpp"
#include "firmware/programs/replay_log.hpp"

namespace {

using namespace striker;
using namespace striker::linux_port;

constexpr int exit_differs = 1;  // replay

struct Options {
  std::string can;
  bool in_process = false;
  std::string replay;
  std::string interface;
  std::string clock = "sync";
  std::string role;
  unsigned sync_timeout_ms = 2000;
  std::optional<std::uint32_t> challenge_seed;
  std::string scheduler = "fifo";
  int priority = 80;
  std::int64_t runtime_us = 300;
  int cpu = -1;
  std::int64_t period_us = 1000;
  RealTimeOptions loop;
  std::string json;
};

void define_bus(CLI::App& app, Options& options) {
  app.add_option("--can", options.can, "CAN interface, for example vcan0");
  app.add_flag("--in-process", options.in_process,
               "no CAN: a bench in this process plays drives, vision and operator; realtime only");
  host::reads_file(
      app.add_option("--replay", options.replay,
                     "no CAN: a candump log of a run in lockstep; its answers are compared, bit by bit"));
  app.add_option("--interface", options.interface, "replay: of the log, where it has more than one");
  app.add_option("--clock", options.clock, "what ticks the controller")
      ->check(CLI::IsMember({"sync", "realtime"}))
      ->capture_default_str();
  app.add_option(
         "--role", options.role,
         "sync: one of AI Soccer's robots instead of the built-in one; goalkeeper and defender have no policy, "
         "and go where their team orders them")
      ->check(CLI::IsMember({"goalkeeper", "defender", "forward"}));
  app.add_option("--sync-timeout", options.sync_timeout_ms, "sync: fault without a SYNC for this long, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  app.add_option(
      "--challenge-seed", options.challenge_seed,
      "what an operator has to confirm follows from it; 0: the same at every start and SYNC(0), for runs "
      "that are compared byte for byte; left out: drawn at random");
}

// Seed 0 is the only one that makes a recording fit: it has to be asked for.
std::uint32_t challenge_seed(const Options& options) {
  std::uint32_t seed = 0;
  while (!options.challenge_seed && seed == 0) {
    if (getrandom(&seed, sizeof seed, 0) != static_cast<ssize_t>(sizeof seed)) {
      throw std::runtime_error("the kernel has no random numbers for challenges: give --challenge-seed");
    }
  }
  return options.challenge_seed.value_or(seed);
}

void define_real_time(CLI::App& app, Options& options) {
  app.add_option("--scheduler", options.scheduler,
                 "the thread's, where permitted; deadline with --cpu needs a cpuset of its own")
      ->check(CLI::IsMember({"fifo", "deadline", "other"}))
      ->capture_default_str();
  app.add_option("--priority", options.priority, "fifo: the priority")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  app.add_option("--runtime-us", options.runtime_us, "deadline: reserved in every period")
      ->check(CLI::Range(10, 1000000))
      ->capture_default_str();
  app.add_option("--cpu", options.cpu, "the only processor to run on")->check(CLI::Range(0, CPU_SETSIZE - 1));
  app.add_option("--period-us", options.period_us,
                 "realtime: of the loop; each is 1 ms to the controller, so others than 1000 are for tests")
      ->check(CLI::Range(50, 1000000))
      ->capture_default_str();
  app.add_option("--frames-per-tick", options.loop.frames_per_tick,
                 "realtime: receive at most so many; more wait for the next tick")
      ->check(CLI::Range(std::uint32_t{1}, greatest_frames_per_tick))
      ->capture_default_str();
  app.add_option("--overrun-limit", options.loop.overrun_limit,
                 "realtime: fault beyond this many missed periods within 1,000")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--ticks", options.loop.ticks, "realtime: stop after this many; 0: at a signal")
      ->capture_default_str();
  host::writes_file(app.add_option("--json", options.json, "realtime: write the timing report at the end"));
}

// What is left out has its default; what is given and would be ignored is refused.
void require_sound(CLI::App& app, const Options& options) {
  const std::size_t buses = app.count("--can") + app.count("--in-process") + app.count("--replay");
  if (buses != 1) {
    throw CLI::ValidationError("--can, --in-process, --replay", "exactly one of them is to be given");
  }
  const bool is_replay = !options.replay.empty();
  const bool is_real_time = options.clock == "realtime";
  if (options.in_process && !is_real_time) {
    throw CLI::ValidationError("--in-process", "has no SYNC: use it with --clock realtime");
  }
  host::require_meaning(app, !can::ForeignDrives<loop::BuiltInDrives>, {"--in-process", "--replay", "--role"},
                        "a build for Striker's own drives");
  host::require_meaning(app, is_replay, {"--interface"}, "--replay");
  host::require_meaning(app, !is_replay,
                        {"--clock", "--role", "--scheduler", "--cpu", "--sync-timeout", "--ticks", "--json",
                         "--period-us", "--frames-per-tick", "--overrun-limit", "--priority", "--runtime-us"},
                        "--can or --in-process");
  host::require_meaning(app, !is_real_time, {"--sync-timeout", "--role"}, "--clock sync");
  host::require_meaning(app, is_real_time,
                        {"--ticks", "--json", "--period-us", "--frames-per-tick", "--overrun-limit"},
                        "--clock realtime");
  host::require_meaning(app, options.scheduler == "fifo", {"--priority"}, "--scheduler fifo");
  host::require_meaning(app, options.scheduler == "deadline", {"--runtime-us"}, "--scheduler deadline");
}

RealTimeSettings settings_of(const Options& options) {
  return {.scheduler = options.scheduler == "fifo"       ? Scheduler::fifo
                       : options.scheduler == "deadline" ? Scheduler::deadline
                                                         : Scheduler::other,
          .priority = options.priority,
          .runtime_ns = options.runtime_us * 1000,
          .period_ns = options.period_us * 1000,
          .cpu = options.cpu};
}

// A thread beside the loop, which stop signals do not reach. `work` is called until the object goes.
class Helper {
 public:
  template <class Work>
  explicit Helper(Work work)
      : thread_([work = std::move(work)](const std::stop_token& stop) mutable {
          sigset_t all;
          sigfillset(&all);
          pthread_sigmask(SIG_SETMASK, &all, nullptr);
          while (!stop.stop_requested()) {
            work();
          }
        }) {}

 private:
  std::jthread thread_;
};

class Bench {
 public:
  Bench(InProcessBus& bus, const RealTimeSettings& settings)
      : peer_(bus), ticks_(clock_, settings.period_ns), helper_([this, settings] {
          if (first_) {
            stay_below(settings);
            first_ = false;
          }
          ticks_.wait();
          peer_.tick(clock_.now_ns());
        }) {}

 private:
  BenchPeer peer_;
  host::MonotonicClock clock_;
  host::PeriodicClock ticks_;
  bool first_ = true;
  Helper helper_;
};

// AI Soccer's goalkeepers and defenders are too slow for the built-in policy.
bool has_policy(const Options& options) {
  return options.role.empty() || options.role == "forward";
}

void print_granted(const Options& options, const Granted& granted) {
  const std::string policy =
      has_policy(options) ? fmt::format("policy {} {:08x}", policy::built_in_name, policy::built_in.identity)
                          : "no policy";
  fmt::print("striker-firmware: on {}, clock {}, {}\n",
             options.in_process ? "a bench in process" : options.can, options.clock, policy);
  for (const std::string& line : granted.lines) {
    fmt::print("  {}\n", line);
  }
  std::fflush(stdout);
  if (!granted.complete) {
    fmt::print(
        stderr,
        "striker-firmware: the kernel refused what stands above: timing is best effort; run as root or grant "
        "CAP_SYS_NICE and CAP_IPC_LOCK\n");
  }
}

core::RobotProfile robot_of(const Options& options) {
  if (options.role.empty()) {
    return loop::built_in_robot;
  }
  return core::profile_of(options.role == "goalkeeper" ? core::goalkeeper
                          : options.role == "defender" ? core::defender
                                                       : core::forward);
}

void run_on_sync(const Options& options) {
  const std::vector<std::uint16_t> others = all_but_stops(can::controller_receives<loop::BuiltInDrives>);
  host::CanSocket socket(options.can, others);
  host::CanSocket stops(options.can, stop_identifiers);
  print_granted(options, ask_for_real_time(settings_of(options)));
  const LockstepSockets sockets = {socket, stops};
  const std::chrono::milliseconds timeout(options.sync_timeout_ms);
  const std::uint32_t seed = challenge_seed(options);
  const LockstepReport report =
      has_policy(options) ? run_lockstep<loop::BuiltInNode>(robot_of(options), sockets, timeout, seed)
                          : run_lockstep<loop::OrderedNode>(robot_of(options), sockets, timeout, seed);
  fmt::print("striker-firmware: stopped after {} ticks; {} frames dropped\n", report.ticks,
             report.dropped_frames);
}

void run_on_own_clock(Options options) {
  options.loop.period_ns = options.period_us * 1000;
  options.loop.challenge_seed = challenge_seed(options);
  const RealTimeSettings settings = settings_of(options);
  std::optional<RealTimeSocket> socket;
  host::MonotonicClock clock;
  InProcessBus in_process(clock);
  std::optional<Bench> bench;
  if (options.in_process) {
    bench.emplace(in_process, settings);
  } else {
    socket.emplace(options.can, can::controller_receives<loop::BuiltInDrives>);
  }
  std::atomic<core::Fault> fault = core::Fault::none;
  FaultAnnouncer announcer;
  std::optional<host::InterfaceWatch<RealTimeSocket>> interface;
  if (socket) {
    interface.emplace(*socket, options.can);
  }
  std::optional<Helper> announcing;
  announcing.emplace([&] {
    announcer.announce(fault.load(std::memory_order_relaxed));
    if (interface) {
      interface->look(std::chrono::steady_clock::now());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });

  Granted granted = ask_for_real_time(settings);
  granted.lines.push_back(fmt::format("a tick every {} us, at most {} frames received in each",
                                      options.period_us, options.loop.frames_per_tick));
  granted.lines.push_back(fmt::format("late by whole periods: skipped; fault beyond {} missed of {}",
                                      options.loop.overrun_limit, loop::OverrunLimit::window_ticks));
  print_granted(options, granted);

  LoopTiming timing;
  if (socket) {
    run_real_time(*socket, clock, options.loop, timing, fault);
  } else {
    run_real_time(in_process, clock, options.loop, timing, fault);
  }
  announcing.reset();
  announcer.announce(fault);
  fmt::print("striker-firmware: {}\n", summary(timing));
  if (!options.json.empty()) {
    write_json(timing, {policy::built_in_name, policy::built_in.identity}, granted.lines, options.json);
  }
}

// Recorded runs have seed 0, unless another is given.
int run_replay(const Options& options) {
  const host::ReplayReport report =
      replay_log(options.replay, options.interface, options.challenge_seed.value_or(0), host::stop_requested);
  fmt::print("{}", host::format_report(report));
  if (host::stop_requested()) {
    return host::exit_interrupted;
  }
  return report.differing == 0 ? 0 : exit_differs;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The kick controller. Stops cleanly on SIGINT or SIGTERM, with torque 0 sent. Exit status: 0 stopped, or a "
      "replay with the recorded answers; 1 a replay with others; 2 wrong use, or a bus that fails; 130 a replay that "
      "was interrupted.",
      "striker-firmware");
  Options options;
  define_bus(app, options);
  define_real_time(app, options);
  app.final_callback([&] { require_sound(app, options); });
  return host::run(
      app, argc, argv,
      [&] {
        host::catch_stop_signals();
        if (!options.replay.empty()) {
          return run_replay(options);
        }
        if (options.clock == "sync") {
          run_on_sync(options);
        } else {
          run_on_own_clock(options);
        }
        return 0;
      },
      fmt::format("policy {} {:08x}", policy::built_in_name, policy::built_in.identity));
}

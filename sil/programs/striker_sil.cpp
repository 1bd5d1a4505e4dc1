// striker-sil: the world around the controller, in lockstep or at wall-clock speed.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/periodic_clock.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/bus/bit_rate.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/bus/timed_link.hpp"
#include "sil/record/candump_log.hpp"
#include "sil/record/decision_csv.hpp"
#include "sil/scenario/kick_run.hpp"

namespace {

using namespace striker;
using namespace striker::sil;

struct Options {
  std::string bus = "inproc";
  std::string plant = "drive";
  std::string pose = "origin";
  std::uint64_t episodes = 20;
  std::uint64_t first = 0;
  std::uint64_t seed = 1;
  bool real_time = false;
  std::int64_t bitrate = 0;
  double step_us = 50.0;
  double vision_phase_us = 0.0;
  unsigned answer_timeout_ms = 1000;
  unsigned start_timeout_ms = 10000;
  std::string json;
  std::string log;
  std::string decisions;
};

void define(CLI::App& kick, Options& options) {
  kick.add_option("--bus", options.bus, "inproc: the controller in this process; can:IFACE: over SocketCAN")
      ->check([](const std::string& bus) {
        return bus == "inproc" || bus.starts_with("can:") ? std::string()
                                                          : "give inproc or can:IFACE, as can:vcan0";
      })
      ->capture_default_str();
  kick.add_option("--plant", options.plant, "servo: the paper's motors, 10 ms; drive: torque drives, 1 ms")
      ->check(CLI::IsMember({"servo", "drive"}))
      ->capture_default_str();
  kick.add_option("--pose", options.pose, "where the robot stands")
      ->check(CLI::IsMember({"origin", "anywhere"}))
      ->capture_default_str();
  kick.add_option("--episodes", options.episodes, "how many")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{900000}))
      ->capture_default_str();
  kick.add_option("--first", options.first,
                  "number of the first episode: each is a function of seed and number")
      ->capture_default_str();
  kick.add_option("--seed", options.seed, "of the episodes")->capture_default_str();
  auto* bitrate = kick.add_option("--bitrate", options.bitrate,
                                  "lockstep: frames take bus time at this rate, in bit/s, and arbitrate");
  bitrate->check(CLI::Validator(bit_rate_problem, "bit/s"));
  kick.add_option("--step-us", options.step_us, "with --bitrate: from SYNC to the controller's frames")
      ->check(CLI::Range(0.0, 900.0))
      ->needs(bitrate)
      ->capture_default_str();
  kick.add_option("--vision-phase-us", options.vision_phase_us, "with --bitrate: from SYNC to the picture")
      ->check(CLI::Range(0.0, 999.0))
      ->needs(bitrate)
      ->capture_default_str();
  kick.add_flag("--realtime", options.real_time, "run at wall-clock speed, without SYNC");
  kick.add_option("--answer-timeout", options.answer_timeout_ms,
                  "lockstep: run on unanswered after this, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  kick.add_option("--start-timeout", options.start_timeout_ms, "lockstep: wait for a controller, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  kick.add_option("--json", options.json, "write the summary and every episode");
  kick.add_option("--log", options.log, "write the bus as a candump log (candump -L)");
  kick.add_option("--decisions", options.decisions,
                  "write the controller's state at each decision as CSV (inproc)");
}

// Absolute 1 ms deadlines, and what became of them.
class Pacer {
 public:
  void wait() {
    const auto wake = clock_.wait();
    missed_ += wake.missed;
    lateness_max_ns_ = std::max(lateness_max_ns_, wake.lateness_ns);
    lateness_sum_ns_ += wake.lateness_ns;
    ++ticks_;
  }
  void report() const {
    fmt::print(
        "simulator's clock: {} ticks, {} periods missed, lateness mean {:.1f} us, max {:.1f} us\n", ticks_,
        missed_,
        static_cast<double>(lateness_sum_ns_) / static_cast<double>(std::max<std::int64_t>(ticks_, 1)) / 1e3,
        static_cast<double>(lateness_max_ns_) / 1e3);
  }

 private:
  host::MonotonicClock monotonic_;
  host::PeriodicClock clock_{monotonic_};
  std::int64_t ticks_ = 0;
  std::uint64_t missed_ = 0;
  std::int64_t lateness_max_ns_ = 0;
  std::int64_t lateness_sum_ns_ = 0;
};

// One line, kept up to date on a terminal; a line every few seconds otherwise.
class Progress {
 public:
  explicit Progress(std::uint64_t episodes) : episodes_(episodes) {}

  void episode_done() {
    ++done_;
    const auto now = Clock::now();
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (now - last_ < (terminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(5000))) {
      return;
    }
    last_ = now;
    const double rate = static_cast<double>(done_) / std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "{}{} of {} episodes, {:.1f}/s, {:.0f} s left{}", terminal ? "\r" : "", done_,
               episodes_, rate, static_cast<double>(episodes_ - done_) / rate, terminal ? "  " : "\n");
    shown_ = terminal;
  }
  void end() const {
    if (shown_) {
      fmt::print(stderr, "\n");
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t episodes_;
  std::uint64_t done_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  bool shown_ = false;
};

std::unique_ptr<ControllerLink> open_link(const Options& options) {
  if (options.bus == "inproc") {
    return std::make_unique<InProcessLink>();
  }
  const std::string interface = options.bus.substr(4);
  if (options.real_time) {
    if (options.bitrate != 0) {
      throw std::runtime_error("--bitrate is for lockstep: leave out --realtime, or use --bus inproc");
    }
    return std::make_unique<FreeRunningLink>(interface);
  }
  return std::make_unique<LockstepLink>(
      interface, SocketCanOptions{std::chrono::milliseconds(options.answer_timeout_ms),
                                  std::chrono::milliseconds(options.start_timeout_ms)});
}

// A tick's frames: as they were received on the bus in time, or all at the tick.
void log_tick(host::AtomicFile& log, const TickRecord& record, const std::optional<TimedLink>& timed) {
  if (timed) {
    for (const StampedFrame& seen : timed->seen()) {
      write_candump(log, seen.received_ns / 1000, seen.frame);
    }
    return;
  }
  for (const can::Frame& frame : *record.frames) {
    write_candump(log, std::int64_t{record.tick} * 1000, frame);
  }
}

void print_bus(const Options& options, const TimedBusReport& bus) {
  fmt::print(
      "bus at {} bit/s: busy {:.1f} %, {} frames replaced while they waited; picture to torque command at "
      "most "
      "{:.3f} ms over {} decisions\n",
      options.bitrate, 100.0 * bus.busy_share, bus.replaced,
      static_cast<double>(bus.decision_latency_max_ns) / 1e6, bus.decisions);
}

int play_kicks(const Options& options) {
  const auto link = open_link(options);
  const auto* in_process = dynamic_cast<const InProcessLink*>(link.get());
  if (!options.decisions.empty() && in_process == nullptr) {
    throw std::runtime_error("--decisions reads the controller's own state: use it with --bus inproc");
  }
  std::optional<host::AtomicFile> log;
  std::optional<DecisionCsv> decisions;
  std::optional<Pacer> pacer;
  std::optional<TimedLink> timed;
  if (options.bitrate != 0) {
    timed.emplace(*link, TimedBusOptions{.bit_ns = bit_time_ns(options.bitrate),
                                         .step_ns = std::llround(options.step_us * 1e3),
                                         .vision_phase_ns = std::llround(options.vision_phase_us * 1e3)});
  }
  if (!options.log.empty()) {
    log.emplace(options.log);
  }
  if (!options.decisions.empty()) {
    decisions.emplace(options.decisions);
  }
  if (options.real_time) {
    pacer.emplace();
  }
  Progress progress(options.episodes);
  KickRunner runner({.plant = options.plant == "servo" ? PlantKind::servo : PlantKind::drive,
                     .pose = options.pose == "anywhere" ? PoseMode::anywhere : PoseMode::origin,
                     .seed = options.seed,
                     .first_episode = options.first,
                     .episodes = options.episodes,
                     .lockstep = !options.real_time || in_process != nullptr},
                    timed ? static_cast<ControllerLink&>(*timed) : *link,
                    {.begin_tick = [&] { pacer ? pacer->wait() : void(); },
                     .end_tick =
                         [&](const TickRecord& record) {
                           if (log) {
                             log_tick(*log, record, timed);
                           }
                           if (decisions && record.deciding) {
                             decisions->observe(in_process->controller(), record.episode, !record.contact);
                           }
                         },
                     .end_episode = [&](const KickOutcome&) { progress.episode_done(); },
                     .stop = host::stop_requested});
  const auto start = std::chrono::steady_clock::now();
  runner.run();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  progress.end();

  const KickRun run{.seed = options.seed,
                    .first_episode = options.first,
                    .plant = options.plant,
                    .pose = options.pose,
                    .policy = runner.policy(),
                    .simulated_s = runner.simulated_s(),
                    .wall_s = wall.count(),
                    .episodes = runner.outcomes()};
  fmt::print("{}", format_table(run, run.episodes.size() <= 50));
  if (timed) {
    print_bus(options, timed->report());
  }
  if (pacer) {
    pacer->report();
  }
  if (log) {
    log->finish();
  }
  if (decisions) {
    decisions->finish();
  }
  if (!options.json.empty()) {
    write_json(run, options.json);
  }
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-sil: stopped after {} of {} episodes; they are kept\n", run.episodes.size(),
               options.episodes);
    return 130;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Software in the loop: an AI Soccer world around the kick controller.", "striker-sil");
  app.require_subcommand(1);
  CLI::App* kick = app.add_subcommand("kick", "play the official kick task");
  Options options;
  define(*kick, options);
  return host::run(app, argc, argv, [&] {
    host::catch_stop_signals();
    return play_kicks(options);
  });
}

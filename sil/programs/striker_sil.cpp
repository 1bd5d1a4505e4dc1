// SPDX-License-Identifier: Apache-2.0
// striker-sil: the world around the controller, in lockstep or at wall-clock speed.
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/bus/bit_rate.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/bus/timed_link.hpp"
#include "sil/programs/campaign_command.hpp"
#include "sil/programs/fault_command.hpp"
#include "sil/programs/kick_options.hpp"
#include "sil/programs/replay_command.hpp"
#include "sil/record/candump_log.hpp"
#include "sil/record/decision_csv.hpp"
#include "sil/record/episode_progress.hpp"
#include "sil/record/pacer.hpp"
#include "sil/robot/striker_drives.hpp"
#include "sil/scenario/kick_scenario.hpp"
#include "sil/task/kick_report.hpp"

namespace {

using namespace striker;
using namespace striker::sil;

// The way to the controller: in process or over a socket, and a bus in time around that if time is asked for.
struct Bus {
  std::unique_ptr<InProcessLink> in_process;
  std::unique_ptr<ControllerLink> socket;
  std::unique_ptr<TimedLink> timed;

  [[nodiscard]] ControllerLink& untimed() const {
    return in_process ? static_cast<ControllerLink&>(*in_process) : *socket;
  }
  [[nodiscard]] ControllerLink& link() const { return timed ? *timed : untimed(); }
};

Bus open_bus(const KickOptions& options) {
  Bus bus;
  const std::string interface = interface_of(options.bus);
  if (options.in_process()) {
    bus.in_process = std::make_unique<InProcessLink>();
  } else if (options.real_time) {
    bus.socket = std::make_unique<FreeRunningLink>(interface);
  } else {
    bus.socket = std::make_unique<LockstepLink>(
        interface, SocketCanOptions{std::chrono::milliseconds(options.answer_timeout_ms),
                                    std::chrono::milliseconds(options.start_timeout_ms)});
  }
  if (options.bitrate != 0) {
    bus.timed = std::make_unique<TimedLink>(
        bus.untimed(), TimedBusOptions{.bit_ns = bit_time_ns(options.bitrate),
                                       .step_ns = std::llround(options.step_us * 1e3),
                                       .vision_phase_ns = std::llround(options.vision_phase_us * 1e3)});
  }
  return bus;
}

using Observers = std::vector<std::unique_ptr<Observer>>;

Observers make_observers(const KickOptions& options, const Bus& bus) {
  Observers observers;
  if (options.real_time) {
    observers.push_back(std::make_unique<Pacer>());
  }
  if (!options.log.empty()) {
    observers.push_back(std::make_unique<CandumpLog>(options.log));
  }
  if (!options.decisions.empty()) {
    observers.push_back(
        std::make_unique<DecisionCsv>(options.decisions, bus.in_process->controller().pilot()));
  }
  observers.push_back(std::make_unique<EpisodeProgress>(options.episodes));
  return observers;
}

constexpr int exit_emergency_stop = 4;

struct Played {
  KickRun run;
  bool emergency_stop;
};

Played play(const KickOptions& options, const Bus& bus, const Observers& owned) {
  const auto plant = make_plant(plant_kind_of(options.plant).value(), 0, Role::forward);
  StrikerDrives drives;
  ExactCamera camera(0);
  Seat seat({.robot = 0,
             .plant = *plant,
             .drives = drives,
             .camera = camera,
             .link = bus.link(),
             .lockstep = !options.real_time || options.in_process()});
  std::vector<Observer*> observers;
  for (const auto& observer : owned) {
    observers.push_back(observer.get());
  }
  KickScenario scenario({.pose = options.pose == "anywhere" ? PoseMode::anywhere : PoseMode::origin,
                         .seed = options.seed,
                         .first_episode = options.first,
                         .episodes = options.episodes},
                        seat, observers);
  const auto start = std::chrono::steady_clock::now();
  scenario.run(host::stop_requested);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {.run = {.seed = options.seed,
                  .first_episode = options.first,
                  .plant = options.plant,
                  .pose = options.pose,
                  .policy = scenario.policy(),
                  .simulated_s = scenario.simulated_s(),
                  .wall_s = wall.count(),
                  .episodes = scenario.outcomes()},
          .emergency_stop = scenario.ended_by_emergency_stop()};
}

void report_bus(std::int64_t bitrate, const TimedBusReport& bus) {
  fmt::print(
      "bus at {} bit/s: busy {:.1f} %, {} frames replaced while they waited; picture to torque command at most "
      "{:.3f} ms over {} decisions\n",
      bitrate, 100.0 * bus.busy_share, bus.replaced, static_cast<double>(bus.decision_latency_max_ns) / 1e6,
      bus.decisions);
}

int play_kicks(const KickOptions& options) {
  require_sound(options);
  const Bus bus = open_bus(options);
  const auto [run, emergency_stop] = play(options, bus, make_observers(options, bus));
  fmt::print("{}", format_table(run, run.episodes.size() <= 50));
  if (bus.timed) {
    report_bus(options.bitrate, bus.timed->report());
  }
  if (!options.json.empty()) {
    write_json(run, options.json);
  }
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-sil: stopped after {} of {} episodes; they are kept\n", run.episodes.size(),
               options.episodes);
    return host::exit_interrupted;
  }
  if (emergency_stop) {
    fmt::print(
        stderr,
        "striker-sil: an emergency stop ended the run after {} of {} episodes; they are kept. Only an operator "
        "clears it: 'striker-command --can IFACE clear'\n",
        run.episodes.size(), options.episodes);
    return exit_emergency_stop;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Software in the loop: an AI Soccer world around the kick controller.", "striker-sil");
  app.require_subcommand(1);
  CLI::App* kick = app.add_subcommand("kick", "play the official kick task");
  KickOptions options;
  define(*kick, options);
  CLI::App* faults = app.add_subcommand("faults", "play the kick task with everything that can go wrong");
  FaultOptions fault_options;
  define(*faults, fault_options);
  CLI::App* campaign = app.add_subcommand("campaign", "play many random combinations of faults");
  CampaignOptions campaign_options;
  define(*campaign, campaign_options);
  CLI::App* replay =
      app.add_subcommand("replay", "give a recorded run's frames to a controller, and compare");
  ReplayOptions replay_options;
  define(*replay, replay_options);
  return host::run(
      app, argc, argv,
      [&] {
        host::catch_stop_signals();
        if (campaign->parsed()) {
          return play_campaign(campaign_options);
        }
        if (replay->parsed()) {
          return play_replay(replay_options);
        }
        return faults->parsed() ? play_faults(fault_options) : play_kicks(options);
      },
      fmt::format("policy {:08x}", policy::built_in.identity));
}

// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/kick_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/bus/bit_rate.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/bus/socketcan_link.hpp"
#include "sil/bus/timed_link.hpp"
#include "sil/policy/loaded_pilot.hpp"
#include "sil/policy/policy_file.hpp"
#include "sil/programs/robot_options.hpp"
#include "sil/record/candump_log.hpp"
#include "sil/record/decision_csv.hpp"
#include "sil/record/episode_journal.hpp"
#include "sil/record/episode_progress.hpp"
#include "sil/record/pacer.hpp"
#include "sil/robot/drives/foreign_drives.hpp"
#include "sil/robot/variation.hpp"
#include "sil/scenario/kick_scenario.hpp"
#include "sil/task/kick_report.hpp"

namespace striker::sil {

namespace {

// The way to the controller: in process or over a socket, and a bus in time around that if time is asked for.
struct Bus {
  std::unique_ptr<InProcessLink> in_process;    // with the built-in policy; or ...
  std::unique_ptr<ControllerLink> with_policy;  // ... with the one that --policy names
  std::unique_ptr<ControllerLink> socket;
  std::unique_ptr<TimedLink> timed;

  [[nodiscard]] ControllerLink& untimed() const {
    return in_process ? static_cast<ControllerLink&>(*in_process) : with_policy ? *with_policy : *socket;
  }
  [[nodiscard]] ControllerLink& link() const { return timed ? *timed : untimed(); }
};

core::RobotDescription robot_of(const KickOptions& options) {
  return described_robot(options.robot, options.policy.empty() ? nullptr : LoadedPilot::suits);
}

Bus open_bus(const KickOptions& options) {
  Bus bus;
  const std::string interface = interface_of(options.bus);
  if (!options.policy.empty()) {
    bus.with_policy = std::make_unique<NodeLink<LoadedNode>>(core::profile_of(robot_of(options)));
  } else if (options.in_process()) {
    bus.in_process = std::make_unique<InProcessLink>(core::profile_of(robot_of(options)));
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

struct Played {
  KickRun run;
  bool emergency_stop = false;
  std::string failure;  // of the bus, or of a file; empty: none
};

// The bus tells a policy's identity alone: its name is known if it is this build's.
std::string name_of_policy(const std::string& identity, const LoadedPolicy& loaded) {
  if (!loaded.name.empty()) {
    return loaded.name;
  }
  const bool is_ours = identity == fmt::format("{:08x}", policy::built_in.identity);
  return is_ours ? policy::built_in_name : "of another build,";
}

// Robot, link and run. The observers' files are complete when it returns.
class KickSession {
 public:
  KickSession(const KickOptions& options, const LoadedPolicy& policy, const Bus& bus,
              const std::vector<Observer*>& observers)
      : options_(&options),
        policy_(&policy),
        robot_(robot_of(options)),
        variation_(completed(variation_of(options.vary), robot_)),
        plants_(make_plants(plant_kind_of(options.plant).value(), spec_of(robot_), variation_)),
        drives_(make_drives(loop::built_in_wiring)),
        camera_(make_camera(variation_, options.seed)),
        seat_({.robot = 0,
               .plant = *plants_.back(),
               .drives = *drives_,
               .camera = *camera_,
               .link = bus.link(),
               .lockstep = !options.real_time || options.in_process()}),
        scenario_({.pose = options.pose == "anywhere" ? PoseMode::anywhere : PoseMode::origin,
                   .seed = options.seed,
                   .first_episode = options.first,
                   .episodes = options.episodes,
                   .reward = options.task == "aimed" ? KickReward::aimed : KickReward::contact,
                   .place = {.robot = varied(spec_of(robot_), variation_),
                             .ball_kept_after_1_s = ball_kept_after_1_s(variation_)},
                   .vision_latency_ticks = variation_.vision_latency_ms.value(),
                   .camera_rate_Hz = variation_.camera_rate_Hz.value(),
                   .pictures_a_motion = core::pictures_a_motion(core::profile_of(robot_)),
                   .needs_controller = options.real_time},
                  seat_, observers) {}

  // The JSON line of the episode that has just ended.
  [[nodiscard]] std::string last_row() const {
    const std::uint64_t episode = options_->first + scenario_.outcomes().size() - 1;
    const bool driven = scenario_.undriven().empty() || scenario_.undriven().back() != episode;
    return row_line(episode, scenario_.outcomes().back(), driven);
  }

  Played play() {
    Played played;
    const auto start = std::chrono::steady_clock::now();
    try {
      scenario_.run(host::stop_requested);
    } catch (const std::runtime_error& error) {
      if (scenario_.outcomes().empty()) {
        throw;
      }
      played.failure = error.what();
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    played.run = {.seed = options_->seed,
                  .first_episode = options_->first,
                  .plant = options_->plant,
                  .pose = options_->pose,
                  .robot = options_->robot,
                  .variation = options_->vary,
                  .policy_name = name_of_policy(scenario_.policy(), *policy_),
                  .policy = scenario_.policy(),
                  .simulated_s = scenario_.simulated_s(),
                  .wall_s = wall.count(),
                  .episodes = scenario_.outcomes(),
                  .undriven = scenario_.undriven()};
    played.emergency_stop = scenario_.ended_by_emergency_stop();
    return played;
  }

 private:
  const KickOptions* options_;
  const LoadedPolicy* policy_;
  core::RobotDescription robot_;
  Variation variation_;
  std::vector<std::unique_ptr<Plant>> plants_;
  std::unique_ptr<WheelDrives> drives_;
  std::unique_ptr<Camera> camera_;
  Seat seat_;
  KickScenario scenario_;
};

void report_bus(std::int64_t bitrate, const TimedBusReport& bus) {
  fmt::print(
      "bus at {} bit/s: busy {:.1f} %, {} frames replaced while they waited; picture to torque command at most "
      "{:.3f} ms over {} decisions\n",
      bitrate, 100.0 * bus.busy_share, bus.replaced, static_cast<double>(bus.decision_latency_max_ns) / 1e6,
      bus.decisions);
}

// How it ended, with a line on stderr where it was not as wanted.
int tell_ending(const KickOptions& options, const Played& played) {
  const std::string finished =
      fmt::format("{} of {} episodes; they are kept", played.run.episodes.size(), options.episodes);
  if (!played.failure.empty()) {
    fmt::print(stderr, "striker-sil: {}: ended after {}\n", played.failure, finished);
    return exit_broken_off;
  }
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-sil: stopped after {}\n", finished);
    return host::exit_interrupted;
  }
  if (played.emergency_stop) {
    fmt::print(
        stderr,
        "striker-sil: an emergency stop ended the run after {}. Only an operator clears it: 'striker-command "
        "--can IFACE clear'\n",
        finished);
    return exit_emergency_stop;
  }
  if (!played.run.undriven.empty()) {
    fmt::print(stderr,
               "striker-sil: {} of {} episodes were played without a controller that drove all along\n",
               played.run.undriven.size(), played.run.episodes.size());
    return exit_not_driven;
  }
  return 0;
}

void write_summary(const KickRun& run, const std::string& file, EpisodeJournal& journal) {
  try {
    write_json(run, file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}; the episodes are in {}", error.what(), journal.file().string()));
  }
  journal.done();
}

}  // namespace

int play_kicks(const KickOptions& options) {
  LoadedPolicy policy;
  if (!options.policy.empty()) {
    policy = load_policy(options.policy);
    LoadedPilot::fly(policy);
  }
  const Bus bus = open_bus(options);
  const Observers owned = make_observers(options, bus);
  std::vector<Observer*> observers;
  for (const auto& observer : owned) {
    observers.push_back(observer.get());
  }
  std::unique_ptr<KickSession> session;
  std::optional<EpisodeJournal> journal;
  if (!options.json.empty()) {
    journal.emplace(options.json, [&] { return session->last_row(); });
    observers.push_back(&*journal);
  }
  session = std::make_unique<KickSession>(options, policy, bus, observers);
  const Played played = session->play();
  fmt::print("{}", format_table(played.run, played.run.episodes.size() <= 50));
  if (bus.timed) {
    report_bus(options.bitrate, bus.timed->report());
  }
  if (journal) {
    write_summary(played.run, options.json, *journal);
  }
  return tell_ending(options, played);
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/kick_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/policy/loaded_pilot.hpp"
#include "sil/policy/policy_file.hpp"
#include "sil/programs/kick/kick_bus.hpp"
#include "sil/programs/robot_options.hpp"
#include "sil/programs/view/view_session.hpp"
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

using Observers = std::vector<std::unique_ptr<Observer>>;

Observers make_observers(const KickOptions& options, const KickBus& bus) {
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
  KickSession(const KickOptions& options, const LoadedPolicy& policy, const KickBus& bus,
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

  // Onto the bus with the next tick.
  void say(const can::Frame& frame) { seat_.queue(frame); }

  // The JSON line of the episode that has just ended.
  [[nodiscard]] std::string last_row() const {
    const std::uint64_t episode = options_->first + scenario_.outcomes().size() - 1;
    const bool driven = scenario_.undriven().empty() || scenario_.undriven().back() != episode;
    return row_line(episode, scenario_.outcomes().back(), driven);
  }

  // `ends` is asked after every tick.
  Played play(const std::function<bool()>& ends) {
    Played played;
    const auto start = std::chrono::steady_clock::now();
    try {
      scenario_.run(ends);
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

void show_to(ViewSession& viewers, const KickOptions& options, const KickBus& bus, KickSession& session) {
  viewers.view.begin_run({.seed = options.seed,
                          .robots = 1,
                          .say = [&session](std::size_t, const can::Frame& frame) { session.say(frame); },
                          .faults = {bus.live.get()},
                          .controllers = {bus.in_process.get()}});
}

int play_once(const KickOptions& options, const LoadedPolicy& policy, ViewSession* viewers) {
  const KickBus bus = open_bus(options);
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
  if (viewers != nullptr) {
    observers.push_back(&viewers->view);
  }
  session = std::make_unique<KickSession>(options, policy, bus, observers);
  if (viewers != nullptr) {
    show_to(*viewers, options, bus, *session);
  }
  const Played played = session->play([&] { return host::stop_requested() || wants_another(viewers); });
  if (wants_another(viewers) && !host::stop_requested()) {
    return 0;
  }
  fmt::print("{}", format_table(played.run, played.run.episodes.size() <= 50));
  if (bus.timed) {
    report_bus(options.bitrate, bus.timed->report());
  }
  if (journal) {
    write_summary(played.run, options.json, *journal);
  }
  return tell_ending(options, played);
}

std::string why_ended(int status) {
  switch (status) {
    case 0:
      return "all episodes were played";
    case exit_not_driven:
      return "some episodes were not driven all along (exit status 3)";
    case exit_emergency_stop:
      return "emergency stop (exit status 4)";
    case host::exit_interrupted:
      return "interrupted (exit status 130)";
    default:
      return fmt::format("exit status {}", status);
  }
}

}  // namespace

int play_kicks(const KickOptions& given) {
  KickOptions options = given;
  LoadedPolicy policy;
  if (!options.policy.empty()) {
    policy = load_policy(options.policy);
    LoadedPilot::fly(policy);
  }
  const auto viewers =
      open_view(options.view, {.scenario = "kick", .teams = {}, .faults = {}, .has_time = !options.real_time},
                options.in_process());
  int status = 0;
  do {
    status = play_once(options, policy, viewers.get());
  } while (begins_anew(viewers.get(), options.seed));
  finish(viewers.get(), why_ended(status));
  return status;
}

}  // namespace striker::sil

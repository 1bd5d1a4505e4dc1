// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/match/match_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/match/play/match_faults.hpp"
#include "sil/match/play/match_links.hpp"
#include "sil/match/record/match_records.hpp"
#include "sil/match/replay/bus_logs.hpp"
#include "sil/match/team/strategies.hpp"
#include "sil/match/team/tcp/tcp_strategy.hpp"
#include "sil/programs/kick_options.hpp"
#include "sil/programs/match/match_options.hpp"
#include "sil/programs/match/player_watch.hpp"
#include "sil/programs/view/view_session.hpp"

namespace striker::sil {

namespace {

// Score and clock on stderr.
class MatchProgress final : public MatchObserver {
 public:
  // Of a match that ends after so much simulated time; 0: of a whole one.
  explicit MatchProgress(double first_s) : first_s_(static_cast<int>(std::ceil(first_s))) {}

  void begin(const MatchHeader& header) override {
    half_s_ = header.rules.half_ms / 1000;
    line_ = std::make_unique<host::ProgressLine>("second", first_s_ > 0 ? first_s_ : 2 * half_s_);
  }
  void frame(const MatchFrame& frame) override {
    const Ruling& ruling = frame.ruling;
    const int done_s = first_s_ > 0 ? static_cast<int>(ruling.sim_ms / 1000)
                                    : (ruling.half - 1) * half_s_ + ruling.clock_ms / 1000;
    if (done_s != shown_s_ && line_->due(done_s)) {
      shown_s_ = done_s;
      line_->show(done_s, fmt::format("{}:{}", ruling.score[0], ruling.score[1]));
    }
  }
  void end(const MatchEnd&) override { line_->finish(); }

 private:
  int first_s_;
  int half_s_ = 0;
  int shown_s_ = 0;
  std::unique_ptr<host::ProgressLine> line_;
};

MatchLinks open_links(const MatchOptions& options) {
  if (options.bus == "inproc") {
    return links_in_process();
  }
  return links_on_can(interface_of(options.bus), {std::chrono::milliseconds(options.answer_timeout_ms),
                                                  std::chrono::milliseconds(options.start_timeout_ms)});
}

std::unique_ptr<Strategy> make_team(const MatchOptions& options, Team team) {
  const std::string& name = options.setting.teams[index_of(team)];
  if (const auto port = tcp_port_of(name)) {
    fmt::print(stderr, "striker-sil: {} waits for a player program on 127.0.0.1, port {}\n", name, *port);
    return std::make_unique<TcpStrategy>(
        TcpOptions{.port = *port,
                   .answer_timeout = std::chrono::milliseconds(options.answer_timeout_ms),
                   .half_ms = options.setting.half_s * 1000,
                   .stop = host::stop_requested});
  }
  return make_strategy(name, team_seed(options.setting, team));
}

}  // namespace

void define(CLI::App& match, MatchOptions& options) {
  MatchSetting& setting = options.setting;
  match.footer(
      "Exit status: 0 played to its end; 2 wrong use, or a bus or file that fails; 130 interrupted: what was played is "
      "kept, and marked as incomplete. A player program that is gone, or does not answer, is told on stderr, and its "
      "frames without an answer in match.json; the match goes on.");
  match
      .add_option("--red", setting.teams[0],
                  "who plays in red, or tcp:PORT: a player program of AI Soccer 2020")
      ->check(team_problem)
      ->capture_default_str();
  match.add_option("--blue", setting.teams[1], "who plays in blue")
      ->check(team_problem)
      ->capture_default_str();
  define_play(match, setting);
  match
      .add_option(
          "--bus", options.bus,
          "inproc: ten controllers in this process; can:PREFIX: over SocketCAN, on PREFIX0 to PREFIX9")
      ->check(bus_problem)
      ->capture_default_str();
  match
      .add_option("--answer-timeout", options.answer_timeout_ms,
                  "a controller on a bus, or a player program, is waited for so long, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  match.add_option("--start-timeout", options.start_timeout_ms, "can: wait for the controllers, in ms")
      ->check(CLI::Range(1, 3600000))
      ->capture_default_str();
  match
      .add_option("--first-s", options.first_s,
                  "play no more than so much simulated time, in s; 0: the whole match")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  host::reads_file(match.add_option(
      "--faults", options.faults,
      "a plan of faults whose cases are named robot0 to robot9 (sil/fault/README.md); inproc, or those of a real bus"));
  match.add_option("-o,--out", options.out,
                   "directory of everything that the match writes; made if it is not there");
  define_view(match, options.view);
}

namespace {

// What viewers may put on a robot's bus stands around its link.
struct LiveLinks {
  std::array<std::unique_ptr<LiveFaults>, robots_in_match> faults;

  LiveLinks(const MatchLinks& links, bool in_process, std::uint64_t seed) {
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      faults[robot] = std::make_unique<LiveFaults>(*links[robot], controller_behind(*links[robot]),
                                                   in_process, seed + robot);
    }
  }
};

void show_to(ViewSession& viewers, const MatchOptions& options, const LiveLinks& links, MatchRun& run) {
  LiveRun live{.seed = options.setting.seed,
               .robots = robots_in_match,
               .say = [&run](std::size_t robot, const can::Frame& frame) { run.say(robot, frame); }};
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    live.faults[robot] = links.faults[robot].get();
    live.controllers[robot] = links.faults[robot]->controller();
  }
  viewers.view.begin_run(std::move(live));
}

int play_once(const MatchOptions& options, ViewSession* viewers) {
  const MatchLinks links = open_links(options);
  std::array<std::unique_ptr<Strategy>, 2> strategies;
  MatchParts parts;
  for (const Team team : teams) {
    auto& strategy = strategies[index_of(team)];
    strategy = make_team(options, team);
    parts.teams[index_of(team)] = strategy.get();
  }
  std::optional<LiveLinks> live;
  if (viewers != nullptr) {
    live.emplace(links, options.bus == "inproc", options.setting.seed);
  }
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    parts.links[robot] = live ? live->faults[robot].get() : links[robot].get();
  }
  MatchProgress progress(options.first_s);
  PlayerWatch players(options.setting.teams, strategies);
  std::vector<MatchObserver*> records = {&progress, &players};
  std::vector<std::unique_ptr<MatchObserver>> files;
  if (!options.out.empty()) {
    files = match_records(options.out);
  }
  for (const auto& file : files) {
    records.push_back(file.get());
  }
  std::vector<Observer*> buses;
  std::optional<BusLogs> logs;
  if (!options.out.empty()) {
    buses.push_back(&logs.emplace(options.out / "bus", robots_in_match));
  }
  if (viewers != nullptr) {
    records.push_back(&viewers->view);
    buses.push_back(&viewers->view);
  }
  parts.records = records;
  parts.buses = buses;
  MatchPlan plan = plan_of(options.setting);
  if (!options.faults.empty()) {
    add_faults(plan, host::read_file(options.faults), options.faults);
  }
  MatchRun run(plan, parts);
  if (viewers != nullptr) {
    show_to(*viewers, options, *live, run);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto is_enough = [&] {
    return host::stop_requested() || wants_another(viewers) ||
           (options.first_s > 0.0 && run.simulated_s() >= options.first_s);
  };
  const MatchEnd end = run.run(is_enough);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  if (wants_another(viewers) && !host::stop_requested()) {
    return 0;
  }
  if (!options.out.empty()) {
    write_timing({.simulated_s = run.simulated_s(), .wall_s = wall.count()}, options.out);
  }
  fmt::print("{} {} : {} {}{}, {:.1f} s simulated, {:.1f} x real time, state {:016x}\n",
             options.setting.teams[0], run.ruling().score[0], run.ruling().score[1], options.setting.teams[1],
             end.complete ? "" : " (incomplete)", run.simulated_s(), run.simulated_s() / wall.count(),
             end.state_hash);
  return host::stop_requested() ? host::exit_interrupted : 0;
}

}  // namespace

int play_match(const MatchOptions& given) {
  MatchOptions options = given;
  const auto viewers = open_view(options.view,
                                 {.scenario = "match",
                                  .teams = {options.setting.teams.begin(), options.setting.teams.end()},
                                  .faults = {}},
                                 options.bus == "inproc");
  int status = 0;
  do {
    status = play_once(options, viewers.get());
  } while (begins_anew(viewers.get(), options.setting.seed));
  finish(viewers.get(), status == 0 ? "the match was played to its end" : "interrupted (exit status 130)");
  return status;
}

}  // namespace striker::sil

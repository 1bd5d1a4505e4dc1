// SPDX-License-Identifier: Apache-2.0
// striker-ceiling: the best that any action sequence gets in each episode, and what scripted rivals get.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "training/ceiling/ceiling_report.hpp"
#include "training/ceiling/ceiling_run.hpp"

namespace striker::training {

namespace {

struct Options {
  CeilingOptions run;
  std::filesystem::path robot;
  std::string task = "kick";
  std::string pose = "origin";
  std::string replay = "fast";
  double position_cell_mm = 5.0;
  double speed_cell_mm_s = 20.0;
  std::filesystem::path json;
  std::filesystem::path csv;
};

int find_ceiling(Options options) {
  CeilingOptions& run = options.run;
  run.reward = options.task == "kick" ? sil::KickReward::contact : sil::KickReward::aimed;
  run.pose = options.pose == "origin" ? sil::PoseMode::origin : sil::PoseMode::anywhere;
  run.replay = options.replay == "fast" ? Physics::planar : Physics::full;
  run.grid = {.position_cell_m = options.position_cell_mm * 1e-3,
              .speed_cell_m_s = options.speed_cell_mm_s * 1e-3,
              .robot = options.robot.empty() ? core::forward : sil::read_robot(options.robot)};
  host::catch_stop_signals();
  const Reachable reachable(run.grid);
  host::ProgressLine line("episode", run.episodes);
  int shown = 0;
  const auto episodes = run_ceiling(run, reachable, [&](int done) {
    if (done > shown && line.due(done)) {
      line.show(done, "");
      shown = done;
    }
    return !host::stop_requested();
  });
  line.finish();
  if (episodes.empty()) {
    fmt::print(stderr, "striker-ceiling: interrupted, nothing is written\n");
    return host::exit_interrupted;
  }
  if (!options.json.empty()) {
    host::write_file(options.json, ceiling_json(run, episodes));
  }
  if (!options.csv.empty()) {
    host::write_file(options.csv, ceiling_csv(run, episodes));
  }
  fmt::print("{}", ceiling_table(run, episodes));
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Finds the best reward that any sequence of the three actions gets in each episode of the official\n"
      "kick task or the aimed one, on the episodes that striker-evaluate and striker-sil play with the same seed, and replays\n"
      "the sequences. The mean is what a score is measured against: (mean reward + 4) / (ceiling + 4).",
      "striker-ceiling");
  Options options;
  app.add_option("--episodes", options.run.episodes, "how many, 1 to 1000000")
      ->required()
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--seed", options.run.seed, "of the episodes")->required();
  striker::host::reads_file(
      app.add_option("--robot", options.robot,
                     "whose ceiling, a description as in firmware/robots; left out: the forward's"));
  app.add_option("--task", options.task, "what the contact is paid for: as in kick, or as in aimed")
      ->check(CLI::IsMember({"kick", "aimed"}))
      ->capture_default_str();
  app.add_option("--pose", options.pose, "the robot's start: origin or anywhere on the field")
      ->check(CLI::IsMember({"origin", "anywhere"}))
      ->capture_default_str();
  app.add_option(
         "--replay", options.replay,
         "the world in which the found actions and the rivals are played: fast or full (wheel bodies)")
      ->check(CLI::IsMember({"fast", "full"}))
      ->capture_default_str();
  app.add_flag("--rivals", options.run.rivals,
               "also play forward, stop, random, a timed interceptor and an on-board planner");
  options.run.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--jobs", options.run.jobs, "threads, 1 to 256; the results do not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--position-cell", options.position_cell_mm, "grid of the search, mm, 1 to 100")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  app.add_option("--speed-cell", options.speed_cell_mm_s, "grid of the search, mm/s, 5 to 500")
      ->check(CLI::Range(5.0, 500.0))
      ->capture_default_str();
  striker::host::writes_file(app.add_option("--json", options.json, "write the figures to this file"));
  striker::host::writes_file(
      app.add_option("--csv", options.csv, "write a row an episode to this file, with the actions"));
  return striker::host::run(app, argc, argv, [&] { return find_ceiling(options); });
}

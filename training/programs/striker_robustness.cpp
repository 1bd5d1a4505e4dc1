// SPDX-License-Identifier: Apache-2.0
// striker-robustness: what a network makes of robots, balls and cameras that nobody described to it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/version.hpp"
#include "sil/world/random_streams.hpp"
#include "training/model/model.hpp"
#include "training/rollout/robots.hpp"
#include "training/run/evaluation.hpp"
#include "training/run/model_task.hpp"

namespace striker::training {

namespace {

struct Options {
  std::filesystem::path model;
  std::filesystem::path config;
  int episodes = 2000;
  std::uint64_t seed = 1000;
  int robots = 200;
  int robot_episodes = 100;
  std::filesystem::path json;
};

struct Row {
  std::vector<std::string> differs;  // from the task's robot, ball and camera: nobody told the network
  // What the description says, and the controller leads through.
  int command_delay_ms = 0;
  int camera_latency_ms = 0;

  [[nodiscard]] std::string name() const {
    std::string name = differs.empty() ? "" : differs.front();
    name += command_delay_ms != 0 ? fmt::format("described command_delay_ms={}", command_delay_ms) : "";
    name += camera_latency_ms != 0 ? fmt::format("described camera_latency_ms={}", camera_latency_ms) : "";
    return name.empty() ? "nominal" : name;
  }
};

// One thing at a time, by what a careful owner gets wrong; the last rows are far off.
std::vector<Row> all_rows() {
  std::vector<Row> rows = {{}};
  for (const char* differs : {"mass=-0.3", "mass=0.3", "torque=-0.3", "torque=0.3", "ball_damping=-0.5",
                              "ball_damping=0.5", "vision_noise_mm=2", "vision_noise_mm=5"}) {
    rows.push_back({.differs = {differs}});
  }
  rows.push_back({.differs = {}, .command_delay_ms = 20});
  rows.push_back({.differs = {}, .command_delay_ms = 50});
  rows.push_back({.differs = {}, .camera_latency_ms = 50});
  for (const char* differs :
       {"command_delay_ms=20", "friction=-0.8", "command_delay_ms=50", "vision_late_ms=50"}) {
    rows.push_back({.differs = {differs}});
  }
  return rows;
}

core::RobotDescription described(core::RobotDescription robot, const Row& row) {
  robot.command_delay_ms = std::max(robot.command_delay_ms, row.command_delay_ms);
  robot.camera_latency_ms = std::max(robot.camera_latency_ms, row.camera_latency_ms);
  return robot;
}

// Of a whole random robot: every one of them is drawn, evenly.
constexpr RandomiseConfig ranges = {.share = 1.0,
                                    .ramp_episodes = 0,
                                    .mass = {-0.3, 0.3},
                                    .torque = {-0.3, 0.3},
                                    .friction = {-0.8, 0.0},
                                    .ball_damping = {-0.5, 0.5},
                                    .command_delay_ms = {0.0, 20.0},
                                    .vision_noise_mm = {0.0, 5.0},
                                    .vision_late_ms = {0.0, 0.0}};

nlohmann::ordered_json json_of(const RobotScore& score) {
  const Conditions& conditions = score.conditions;
  return {{"mass_scale", conditions.mass_scale},
          {"torque_scale", conditions.torque_scale},
          {"friction_scale", conditions.friction_scale},
          {"ball_damping_scale", conditions.ball_damping_scale},
          {"command_delay_steps", conditions.command_delay_steps},
          {"vision_noise_m", conditions.vision_noise_m},
          {"vision_late_frames", conditions.vision_late_frames},
          {"network", score.network},
          {"planner", score.planner},
          {"share", score.share()}};
}

int play_all(const Options& options) {
  const Model model = load_model(options.model, "");
  TaskConfig task = task_of(model, options.model, options.config);
  task.velocities = Velocities::estimated;
  if (const std::string why = LineKick::unfit(task); !why.empty()) {
    throw std::runtime_error("the model's task cannot be played on a line: " + why);
  }
  const std::vector<Row> rows = all_rows();
  host::ProgressLine line("robot", static_cast<int>(rows.size()) + options.robots);
  nlohmann::ordered_json report = {{"policy", model_identity(model.parameters)}, {"seed", options.seed}};
  int played = 0;
  std::string table = fmt::format("{:<33}  network  planner  share %\n", "robot");
  for (const Row& row : rows) {
    TaskConfig played_task = task;
    played_task.robot = described(task.robot, row);
    const RobotScore score = score_on(conditions_of(row.differs), LineKick(played_task), model.parameters,
                                      {.seed = options.seed, .first = 0, .episodes = options.episodes});
    table += fmt::format("{:<33}  {:7.3f}  {:7.3f}  {:7.1f}\n", row.name(), score.network, score.planner,
                         100.0 * score.share());
    report["rows"].push_back(json_of(score));
    report["rows"].back()["described_command_delay_ms"] = played_task.robot.command_delay_ms;
    report["rows"].back()["described_camera_latency_ms"] = played_task.robot.camera_latency_ms;
    if (line.due(++played)) {
      line.show(played, row.name());
    }
  }
  const LineKick kick(task);
  std::vector<double> shares;
  for (int robot = 0; robot < options.robots; ++robot) {
    sil::Random random(options.seed, static_cast<std::uint64_t>(robot), sil::random_stream::conditions);
    const RobotScore score = score_on(
        draw_conditions(ranges, 1.0, random), kick, model.parameters,
        {.seed = options.seed,
         .first = static_cast<std::uint64_t>(robot) * static_cast<std::uint64_t>(options.robot_episodes),
         .episodes = options.robot_episodes});
    shares.push_back(score.share());
    report["random"].push_back(json_of(score));
    if (line.due(++played)) {
      line.show(played, "random");
    }
  }
  line.finish();
  fmt::print("{}", table);
  if (!shares.empty()) {
    fmt::print(
        "{} random robots, {} episodes each: share median {:.1f} %, worst decile {:.1f} %, worst {:.1f} %\n",
        options.robots, options.robot_episodes, 100.0 * quantile(shares, 0.5), 100.0 * quantile(shares, 0.1),
        100.0 * quantile(shares, 0.0));
  }
  if (!options.json.empty()) {
    host::stamp(report);
    host::write_file(options.json, report.dump(2) + "\n");
  }
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Plays a kick network, in the training's world, on robots, balls and cameras that differ from the\n"
      "nominal ones in one thing, and on random ones that differ in all, beside a planner that knows the\n"
      "true ones. The share is of the planner's way from an episode without contact.",
      "striker-robustness");
  Options options;
  striker::host::reads_file(app.add_option("--model", options.model, "safetensors file"))->required();
  app.add_option("--config", options.config,
                 "the TOML file whose task it was trained for, if the model does not hold it");
  app.add_option("--episodes", options.episodes, "of each robot that differs in one thing")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of episodes and robots")->capture_default_str();
  app.add_option("--robots", options.robots,
                 "random ones: mass and torque +-30 %, friction down to a fifth,\n"
                 "ball damping +-50 %, commands up to 20 ms late, noise up to 5 mm")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  app.add_option("--robot-episodes", options.robot_episodes, "of each random one")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  striker::host::writes_file(
      app.add_option("--json", options.json, "write every robot's figures to this file"));
  return striker::host::run(app, argc, argv, [&] { return play_all(options); });
}

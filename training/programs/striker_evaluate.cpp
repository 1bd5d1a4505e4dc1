// SPDX-License-Identifier: Apache-2.0
// striker-evaluate: what a float network is worth, on held-out episodes or beside a controller's decisions.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/version.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "sil/task/kick_report.hpp"
#include "sil/task/mean_estimate.hpp"
#include "training/export/comparison/agreement.hpp"
#include "training/export/comparison/optional_json.hpp"
#include "training/line/line_episode.hpp"
#include "training/model/model.hpp"
#include "training/rollout/robots.hpp"
#include "training/run/evaluation.hpp"
#include "training/run/model_task.hpp"
#include "training/task/kick_environment.hpp"

namespace striker::training {

namespace {

struct Options {
  std::filesystem::path model;
  std::string network;
  int episodes = 0;
  std::uint64_t seed = 0;
  std::string pose = "origin";
  std::string velocities = "true";
  std::string world = "full";
  std::filesystem::path config;
  std::filesystem::path robot;
  std::vector<std::string> conditions;
  std::filesystem::path decisions;
  std::filesystem::path json;
};

int evaluate_play(const Options& options, const Model& model, TaskConfig task) {
  task.pose = options.pose == "origin" ? sil::PoseMode::origin : sil::PoseMode::anywhere;
  task.velocities = options.velocities == "true" ? Velocities::exact : Velocities::estimated;
  task.physics = options.world == "full" ? Physics::full : Physics::planar;
  KickEnvironment env(task);
  GreedyRule greedy(model.parameters);
  sil::KickRun run;
  run.seed = options.seed;
  run.plant = "servo";
  run.pose = options.pose;
  run.policy = model_identity(model.parameters);
  const auto start = std::chrono::steady_clock::now();
  host::ProgressLine line("episode", options.episodes, 0, std::chrono::seconds(1));
  double sum = 0.0;
  for (int i = 0; i < options.episodes; ++i) {
    const auto episode = static_cast<std::uint64_t>(i);
    run.episodes.push_back(play(env, options.seed, episode, greedy));
    sum += run.episodes.back().reward;
    if (line.due(i + 1)) {
      line.show(i + 1, fmt::format("mean reward {:.2f}", sum / (i + 1)));
    }
  }
  line.finish();
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.simulated_s = env.simulated_s();
  if (!options.json.empty()) {
    sil::write_json(run, options.json);
  }
  fmt::print("{}", sil::format_table(run, false));
  return 0;
}

// A robot that is not the nominal one, on a line.
int evaluate_conditions(const Options& options, const Model& model, TaskConfig task) {
  task.velocities = options.velocities == "true" ? Velocities::exact : Velocities::estimated;
  if (const std::string why = LineKick::unfit(task); !why.empty()) {
    throw std::runtime_error("--condition: the model's task cannot be played on a line: " + why);
  }
  const std::vector<double> rewards =
      greedy_rewards(conditions_of(options.conditions), LineKick(task), model.parameters,
                     {.seed = options.seed, .first = 0, .episodes = options.episodes});
  const sil::MeanEstimate mean = sil::mean_estimate(rewards);
  if (!options.json.empty()) {
    nlohmann::ordered_json report = {{"policy", model_identity(model.parameters)},
                                     {"conditions", options.conditions},
                                     {"episodes", options.episodes},
                                     {"seed", options.seed},
                                     {"mean_reward", mean.mean},
                                     {"standard_error", mean.standard_error}};
    host::stamp(report);
    host::write_file(options.json, report.dump(2) + "\n");
  }
  fmt::print("{}: mean reward {:.3f} +- {:.3f} (95 %)\n", fmt::join(options.conditions, ", "), mean.mean,
             1.96 * mean.standard_error);
  return 0;
}

int evaluate_decisions(const Options& options, const Model& model, const TaskConfig& task) {
  const Agreement result =
      agreement(model.parameters, task.inputs,
                load_decisions(options.decisions, task.inputs, model.parameters.shape().actions));
  if (!options.json.empty()) {
    nlohmann::ordered_json report = {{"policy", model_identity(model.parameters)},
                                     {"states", result.states},
                                     {"agreement", number_or_null(result.agreement)},
                                     {"clear_gap", clear_gap},
                                     {"clear_states", result.clear_states},
                                     {"clear_agreement", number_or_null(result.clear_agreement)},
                                     {"mean_regret", number_or_null(result.mean_regret)}};
    host::stamp(report);
    host::write_file(options.json, report.dump(2) + "\n");
  }
  fmt::print(
      "states before contact      {}\nagreement, all states      {}\n"
      "agreement, Q gap > {}    {} ({} states)\nmean regret in float Q     {}\n",
      result.states, share_text(result.agreement, 4), clear_gap, share_text(result.clear_agreement, 4),
      result.clear_states, share_text(result.mean_regret, 5));
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Plays the kick task greedily with a float network (ODE world, servo plant), on episodes that no\n"
      "training meets: episode i of a seed is the same one in striker-sil. With --decisions it plays\n"
      "nothing, but says how far the choices in a file that striker-sil wrote agree with the network's.\n"
      "The network may come from elsewhere (PyTorch, Stable-Baselines3), if it was saved as safetensors\n"
      "in float32.",
      "striker-evaluate");
  Options options;
  striker::host::reads_file(app.add_option("--model", options.model, "safetensors file"))->required();
  auto* episodes = app.add_option("--episodes", options.episodes, "how many, 1 to 10000000")
                       ->check(CLI::Range(1, 10'000'000));
  auto* seed = app.add_option("--seed", options.seed, "of the episodes");
  app.add_option("--pose", options.pose, "the robot's start: origin or anywhere on the field")
      ->check(CLI::IsMember({"origin", "anywhere"}))
      ->capture_default_str();
  app.add_option(
      "--network", options.network,
      "which of several networks in the file: how its tensors' names begin, such as q_net or model");
  app.add_option("--config", options.config,
                 "the TOML file whose task it was trained for, if the model does not hold it");
  auto* robot = striker::host::reads_file(app.add_option(
      "--robot", options.robot,
      "plays with this robot, a description as in firmware/robots, instead of the one it was trained for"));
  app.add_option("--velocities", options.velocities, "what the network sees: true or estimated velocities")
      ->check(CLI::IsMember({"true", "estimated"}))
      ->capture_default_str();
  app.add_option("--world", options.world, "full: wheel bodies (the reference); fast: the training's world")
      ->check(CLI::IsMember({"full", "fast"}))
      ->capture_default_str();
  auto* condition =
      app.add_option("--condition", options.conditions,
                     "plays in the training's world with a robot that is not the nominal one: a key of\n"
                     "[randomise] in paper.toml and a value, such as mass=-0.3 or vision_late_ms=50")
          ->type_name("KEY=VALUE")
          ->allow_extra_args(false)
          ->needs(episodes);
  auto* decisions = striker::host::reads_file(
      app.add_option("--decisions", options.decisions, "CSV file of a controller's decisions"));
  striker::host::writes_file(app.add_option("--json", options.json, "write the figures to this file"));
  episodes->needs(seed)->excludes(decisions);
  robot->needs(episodes);
  return striker::host::run(app, argc, argv, [&] {
    if (!*episodes && !*decisions) {
      throw std::runtime_error("give --episodes and --seed, or --decisions");
    }
    const Model model = load_model(options.model, options.network);
    const TaskConfig own = task_of(model, options.model, options.config);
    const TaskConfig task = *robot ? with_robot(own, striker::sil::read_robot(options.robot)) : own;
    if (*condition) {
      return evaluate_conditions(options, model, task);
    }
    return *decisions ? evaluate_decisions(options, model, task) : evaluate_play(options, model, task);
  });
}

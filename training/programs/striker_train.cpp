// SPDX-License-Identifier: Apache-2.0
// striker-train: learns the kick from a configuration and a seed, and writes a model and its learning curve.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "sil/robot/description/robot_file.hpp"
#include "training/run/directory/train_into.hpp"
#include "training/run/model_task.hpp"

namespace striker::training {

namespace {

constexpr int exit_diverged = 3;

struct Options {
  std::filesystem::path config;
  std::filesystem::path robot;
  std::vector<std::string> changes;
  std::uint64_t seed = 0;
  std::filesystem::path out;
  std::filesystem::path init;
  std::string network;
  bool resume = false;
  bool force = false;

  [[nodiscard]] Start start() const { return resume ? Start::resume : force ? Start::force : Start::fresh; }
};

std::string mean_or_not(std::optional<double> mean) {
  return mean ? fmt::format("{:.3f}", *mean) : "not measured";
}

void report(const TrainingResult& result, const Config& config, const std::filesystem::path& out) {
  fmt::print(
      "{} episodes, {} decisions, {} gradient steps; mean reward over the last {}: {:.3f}; greedy, on {} validation episodes: {}\n",
      result.episodes, result.decisions, result.gradient_steps,
      std::min(moving_average_span, result.episodes), result.moving_average, config.run.validation_episodes,
      mean_or_not(result.mean_reward));
  if (result.best_mean_reward) {
    fmt::print("best on the way: {:.3f}, {}\n", *result.best_mean_reward,
               (out / "best.safetensors").string());
  }
  fmt::print("{}\n{}\n", (out / "model.safetensors").string(), (out / "learning_curve.csv").string());
}

// The network that it begins from; nothing: random weights.
std::optional<Parameters> initial_network(const Options& options, const Config& config) {
  if (options.init.empty()) {
    return std::nullopt;
  }
  const Model model = load_model(options.init, options.network);
  require_fits(model, config, options.init.string());
  return model.parameters;
}

TrainingResult train_with_progress(const Options& options, const Config& config) {
  const std::optional<Parameters> initial = initial_network(options, config);
  host::ProgressLine line("episode", config.run.episodes);
  const auto progress = [&line](const CurveRow& row) {
    const int done = row.episode.episode + 1;
    if (line.due(done)) {
      line.show(done, fmt::format("reward {:.2f} (mean of {})", row.moving_average,
                                  std::min(done, moving_average_span)));
    }
    return !host::stop_requested();
  };
  try {
    const TrainingResult result = train_into(options.out, config, options.seed, options.start(), progress,
                                             initial ? &*initial : nullptr);
    line.finish();
    return result;
  } catch (...) {
    line.finish();
    throw;
  }
}

// The robot first: --set may change it, too.
std::vector<std::string> changes_of(const Options& options) {
  std::vector<std::string> changes =
      options.robot.empty() ? std::vector<std::string>{} : robot_changes(sil::read_robot(options.robot));
  changes.insert(changes.end(), options.changes.begin(), options.changes.end());
  return changes;
}

int train_and_save(const Options& options) {
  const Config config = load_config(options.config, changes_of(options));
  host::catch_stop_signals();
  TrainingResult result;
  try {
    result = train_with_progress(options, config);
  } catch (const TrainingDiverged& diverged) {
    fmt::print(stderr, "striker-train: {}\n", diverged.what());
    return exit_diverged;
  }
  report(result, config, options.out);
  if (result.interrupted) {
    fmt::print(
        stderr,
        "striker-train: interrupted after {} of {} episodes; everything so far is kept, add --resume to go on\n",
        result.episodes, config.run.episodes);
    return host::exit_interrupted;
  }
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Trains a Q network on the kick task (servo plant) and writes DIR/model.safetensors,\n"
      "learning_curve.csv, speed.csv and, where the configuration asks for greedy evaluations,\n"
      "best.safetensors and evaluations.csv. training/README.md explains every column.\n"
      "The same configuration and seed give the same bytes on one type of machine (but for speed.csv).\n"
      "Ctrl-C ends it after the running episode and keeps everything (exit status 130); --resume goes on.\n"
      "A loss, Q value or weight that is not finite ends it too (exit status 3), with the message saying which\n"
      "of the files are sound; no model is written. Exit status 2: wrong use, or an input that cannot be used.",
      "striker-train");
  Options options;
  app.add_option("--config", options.config, "TOML file, see training/configs/paper.toml for every key")
      ->required();
  app.add_option("--set", options.changes, "changes a key of it: --set learner.gamma=0.99")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  striker::host::reads_file(
      app.add_option("--robot", options.robot,
                     "the robot that it is for, a description as in firmware/robots: instead of [robot]"));
  app.add_option("--seed", options.seed, "of the weights, the episodes, the exploration and the sampling")
      ->required();
  app.add_option("--out", options.out, "directory for the results; made if missing")->required();
  auto* resume = app.add_flag(
      "--resume", options.resume,
      "go on with the training in that directory; run.episodes, the learning rate and exploration may be "
      "others than before");
  auto* init =
      app.add_option("--init", options.init,
                     "begin from the network in this safetensors file instead of random weights; think of "
                     "exploration.epsilon_start")
          ->excludes(resume);
  app.add_option("--network", options.network, "which of several networks in that file")->needs(init);
  app.add_flag("--force", options.force, "remove the files of the training in that directory, and begin anew")
      ->excludes(resume);
  return striker::host::run(app, argc, argv, [&options] { return train_and_save(options); });
}

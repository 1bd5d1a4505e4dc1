// striker-train: learns the kick from a configuration and a seed, and writes a model and its learning curve.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>

#include "cli.hpp"
#include "dqn.hpp"
#include "files.hpp"
#include "model.hpp"
#include "progress.hpp"

namespace striker::training {

namespace {

constexpr int exit_interrupted = 130;

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int /*signal*/) {
  interrupted = 1;
}

struct Options {
  std::filesystem::path config;
  std::uint64_t seed = 0;
  std::filesystem::path out;
};

std::string learning_curve(const std::vector<EpisodeRow>& rows) {
  std::string csv = "episode,steps,reward,moving_average_250,contact,epsilon,loss\n";
  for (const EpisodeRow& row : rows) {
    fmt::format_to(std::back_inserter(csv), "{},{},{:.6f},{:.6f},{},{:.6f},{:.6g}\n", row.episode, row.steps,
                   row.reward, row.moving_average, row.contact ? 1 : 0, row.epsilon, row.loss);
  }
  return csv;
}

Model model_of(const Config& config, std::uint64_t seed, const Training& training) {
  Model model{.parameters = training.parameters, .metadata = {}};
  const bool printed = config.environments.front().equations == Equations::printed;
  model.metadata = {{"configuration", config.text},
                    {"configuration_name", config.name},
                    {"episodes", std::to_string(training.rows.size())},
                    {"equations", printed ? "printed" : "corrected"},
                    {"identity", model_identity(training.parameters)},
                    {"seed", std::to_string(seed)}};
  if (config.validation_episodes > 0 && interrupted == 0) {
    model.metadata["mean_reward"] = fmt::format("{:.3f}", validate(config, training.parameters, seed));
  }
  return model;
}

int train_and_save(const Options& options) {
  const Config config = load_config(options.config);
  require_writable(options.out);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);

  ProgressLine line(config.episodes);
  const Training training = train(config, options.seed, [&line](const EpisodeRow& row) {
    line.show(row);
    return interrupted == 0;
  });
  line.finish();

  const Model model = model_of(config, options.seed, training);
  save_model(model, options.out / "model.safetensors");
  write_file(options.out / "learning_curve.csv", learning_curve(training.rows));
  const auto mean = model.metadata.find("mean_reward");
  fmt::print(
      "{} episodes, {} decisions, {} gradient steps; mean reward over the last {}: {:.3f}; greedy, on {} "
      "validation episodes: {}\n{}\n{}\n",
      training.rows.size(), training.decisions, training.gradient_steps,
      std::min<std::size_t>(moving_average_span, training.rows.size()), training.rows.back().moving_average,
      config.validation_episodes, mean == model.metadata.end() ? "not measured" : mean->second,
      (options.out / "model.safetensors").string(), (options.out / "learning_curve.csv").string());
  if (interrupted != 0) {
    fmt::print(
        stderr,
        "striker-train: interrupted after {} of {} episodes; the model and the curve so far are kept\n",
        training.rows.size(), config.episodes);
    return exit_interrupted;
  }
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Trains a Q network on the official kick task (ODE world, servo plant) and writes "
      "DIR/model.safetensors\n"
      "and DIR/learning_curve.csv. The same configuration and seed give the same bytes on one type of "
      "machine.\n"
      "Ctrl-C ends it after the running episode and keeps what was learnt so far (exit code 130).",
      "striker-train");
  Options options;
  app.add_option("--config", options.config, "TOML file, see training/configs/paper.toml for every key")
      ->required();
  app.add_option("--seed", options.seed, "of the weights, the episodes, the exploration and the sampling")
      ->required()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--out", options.out, "directory for the model and the learning curve; made if missing")
      ->required();
  return run(app, argc, argv, [&options] { return train_and_save(options); });
}

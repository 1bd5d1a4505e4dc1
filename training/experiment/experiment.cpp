// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/experiment.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "firmware/host/files.hpp"
#include "firmware/host/version.hpp"
#include "training/learner/divergence.hpp"
#include "training/model/hash.hpp"
#include "training/model/model.hpp"
#include "training/run/evaluation.hpp"
#include "training/run/training_run.hpp"

namespace striker::training {

namespace {

constexpr const char* curve_header = "episode,reward,moving_average_250\n";

struct Change {
  std::string name;
  std::string says;
  std::vector<std::string> settings;
};

std::vector<Variant> vary(const std::string& base_text, const std::string& base_name,
                          const std::vector<Change>& changes) {
  std::vector<Variant> variants;
  variants.reserve(changes.size());
  for (const auto& [name, says, settings] : changes) {
    variants.push_back({name, says, parse_config(base_text, base_name, settings)});
  }
  return variants;
}

std::string configuration_hash(const Variant& variant) {
  return fmt::format("{:08x}", fnv1a(variant.config.text));
}

// Mean greedy reward on the episodes that an evaluation draws.
double mean_reward_at(sil::PoseMode pose, TaskConfig task, const Parameters& parameters) {
  task.pose = pose;
  return mean_reward(task, parameters, evaluation_seed, 0, evaluation_episodes);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why, const SeedRun& run) {
  throw std::runtime_error(fmt::format("{}: {}; remove the files seed-{}.* beside it to repeat this run",
                                       file.string(), why, run.seed));
}

std::vector<double> read_curve(const std::filesystem::path& file, const SeedRun& run) {
  std::istringstream lines(host::read_file(file));
  std::string line;
  std::vector<double> rewards;
  if (!std::getline(lines, line) || line + "\n" != curve_header) {
    refuse(file, "not the learning curve of a run", run);
  }
  while (std::getline(lines, line) && !lines.eof()) {
    const std::string number = fmt::format("{},", rewards.size());
    char* end = nullptr;
    const double reward = line.starts_with(number) ? std::strtod(line.c_str() + number.size(), &end) : 0.0;
    if (end == nullptr || *end != ',') {
      refuse(file, fmt::format("line {} is not that of episode {}", rewards.size() + 2, rewards.size()), run);
    }
    rewards.push_back(reward);
  }
  const int episodes = run.variant->config.run.episodes;
  if (static_cast<int>(rewards.size()) != episodes) {
    refuse(file, fmt::format("{} of {} episodes: it was cut off", rewards.size(), episodes), run);
  }
  return rewards;
}

// The curve of a whole training.
std::string trained_curve(Training& training, const SeedRun& run) {
  std::string curve = curve_header;
  try {
    while (!training.done()) {
      for (const auto& [episode, moving_average] : training.play_round()) {
        curve += fmt::format("{},{:.6f},{:.6f}\n", episode.episode, episode.reward, moving_average);
      }
    }
  } catch (const Divergence& divergence) {
    throw std::runtime_error(
        fmt::format("the training diverged: {}; nothing of the run was written; try a lower "
                    "optimiser.learning_rate (it is {}) with --set, in another directory",
                    divergence.what(), run.variant->config.optimiser.learning_rate));
  }
  return curve;
}

}  // namespace

std::vector<Variant> paper_variants(const std::string& base_text, const std::string& base_name) {
  return vary(base_text, base_name,
              {{"rcs", "RCS, 6 inputs", {}},
               {"rcs+1", "RCS and 1 dummy", {"task.dummies=1"}},
               {"rcs+2", "RCS and 2 dummies", {"task.dummies=2"}},
               {"rcs+4", "RCS and 4 dummies, the ACS's size", {"task.dummies=4"}},
               {"rcs+8", "RCS and 8 dummies", {"task.dummies=8"}},
               {"acs-origin", "ACS, robot at the origin", {"task.inputs=\"acs\""}},
               {"acs-anywhere", "ACS, robot anywhere", {"task.inputs=\"acs\"", "task.pose=\"anywhere\""}},
               {"rcs-printed", "RCS, the printed equations", {"task.equations=\"printed\""}}});
}

std::vector<Variant> paper_readings(const std::string& base_text, const std::string& base_name) {
  const std::string every = "reward.contacts=\"every\"";
  const std::string go_on = "reward.after_contact=\"go on\"";
  const std::string without_sign = "reward.contact_speed=\"unsigned\"";
  const std::string near_aim = "ball.aim_radius_m=0.1";
  const std::string slow = "ball.speed_m_s=[0.5, 1.5]";
  return vary(base_text, base_name,
              {{"official", "the official task", {}},
               {"go-on", "episodes go on after the contact", {go_on}},
               {"every", "each decision with a contact pays, episodes go on", {every, go_on}},
               {"unsigned", "V_contact without sign", {without_sign}},
               {"near", "the ball aimed within 0.1 m", {near_aim}},
               {"far", "the ball aimed within 1 m", {"ball.aim_radius_m=1.0"}},
               {"slow", "ball 0.5 to 1.5 m/s", {slow}},
               {"fast", "ball 2 to 4 m/s", {"ball.speed_m_s=[2.0, 4.0]"}},
               {"every-near", "each contact pays, aimed within 0.1 m", {every, go_on, near_aim}},
               {"every-slow", "each contact pays, ball 0.5 to 1.5 m/s", {every, go_on, slow}},
               {"every-near-slow",
                "each contact pays, within 0.1 m, 0.5 to 1.5 m/s",
                {every, go_on, near_aim, slow}}});
}

std::vector<Variant> network_widths(const std::string& base_text, const std::string& base_name) {
  std::vector<Change> changes;
  for (const int width : {32, 64, 128, 192}) {
    changes.push_back({fmt::format("width-{}", width),
                       fmt::format("two hidden layers of {}", width),
                       {fmt::format("network.hidden=[{0}, {0}]", width)}});
  }
  return vary(base_text, base_name, changes);
}

std::vector<Variant> compared_variants(const std::vector<std::filesystem::path>& files,
                                       const std::vector<std::string>& changes) {
  std::vector<Variant> variants;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    Variant variant{.name = name, .says = name, .config = load_config(file, changes)};
    for (const Variant& other : variants) {
      if (other.name == name) {
        throw std::runtime_error(
            fmt::format("{}: another file is named {}, too; give one another name", file.string(), name));
      }
      if (other.config.text == variant.config.text) {
        throw std::runtime_error(
            fmt::format("{}: is the same training as {}; change a key of it", file.string(), other.name));
      }
    }
    variants.push_back(std::move(variant));
  }
  return variants;
}

std::string name_of(const SeedRun& run) {
  return fmt::format("{}, seed {}", run.variant->name, run.seed);
}

std::array<std::filesystem::path, 3> files_of(const SeedRun& run, const std::filesystem::path& directory) {
  const auto stem = directory / "runs" / run.variant->name / fmt::format("seed-{}", run.seed);
  return {stem.string() + ".csv", stem.string() + ".safetensors", stem.string() + ".json"};
}

void carry_out(const SeedRun& run, const std::filesystem::path& directory) {
  const auto [curve_file, model_file, figures_file] = files_of(run, directory);
  host::require_writable(curve_file.parent_path());
  Training training(run.variant->config, run.seed);
  const std::string curve = trained_curve(training, run);
  const Model model = model_of(training);
  const TaskConfig& task = run.variant->config.environments.front();
  nlohmann::ordered_json figures = {
      {"variant", run.variant->name},
      {"seed", run.seed},
      {"configuration_hash", configuration_hash(*run.variant)},
      {"identity", model.metadata.at("identity")},
      {"decisions", training.decisions()},
      {"evaluation_seed", evaluation_seed},
      {"evaluation_episodes", evaluation_episodes},
      {"origin_mean", mean_reward_at(sil::PoseMode::origin, task, model.parameters)},
      {"anywhere_mean", mean_reward_at(sil::PoseMode::anywhere, task, model.parameters)}};
  host::stamp(figures);
  host::write_file(curve_file, curve);
  save_model(model, model_file);
  host::write_file(figures_file, figures.dump(2) + "\n");
}

std::optional<RunFigures> load_run(const SeedRun& run, const std::filesystem::path& directory) {
  const auto [curve_file, model_file, figures_file] = files_of(run, directory);
  if (!std::filesystem::exists(figures_file)) {
    return std::nullopt;
  }
  const auto figures = nlohmann::json::parse(host::read_file(figures_file), nullptr, false);
  if (!figures.is_object() || !figures.contains("anywhere_mean") || !figures.contains("identity")) {
    refuse(figures_file, "not the figures of a run", run);
  }
  if (figures.value("configuration_hash", "") != configuration_hash(*run.variant)) {
    refuse(figures_file, "made with another configuration; choose another directory, or", run);
  }
  RunFigures result;
  result.rewards = read_curve(curve_file, run);
  if (model_identity(load_model(model_file).parameters) != figures["identity"]) {
    refuse(model_file, "not the model of this run", run);
  }
  result.origin_mean = figures.at("origin_mean").get<double>();
  result.anywhere_mean = figures.at("anywhere_mean").get<double>();
  return result;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/run/config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "firmware/host/files.hpp"
#include "paper_toml.hpp"
#include "training/run/task_reader.hpp"
#include "training/run/toml_reader.hpp"

namespace striker::training {

namespace {

constexpr const char* default_kind = "kick";

toml::table parse(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}: line {}: {}", file, error.source().begin.line, error.description()));
  }
}

std::vector<std::string> keys_of(const toml::table& root) {
  std::vector<std::string> keys;
  for (const auto& [name, value] : root) {
    for (const auto& [inner, ignored] : *value.as_table()) {
      keys.push_back(fmt::format("{}.{}", name.str(), inner.str()));
    }
  }
  return keys;
}

[[noreturn]] void refuse_key(const std::string& file, const std::string& key, const toml::table& known) {
  throw std::runtime_error(
      fmt::format("{}: {} is not a key of a training configuration; it may be one of: {}", file, key,
                  fmt::join(keys_of(known), ", ")));
}

// Puts the values of `from` in the place of those of `into`, which has every key that there may be.
void override_with(const toml::table& from, toml::table& into, const std::string& file) {
  for (const auto& [name, value] : from) {
    toml::table* const target = into[name.str()].as_table();
    const toml::table* const table = value.as_table();
    if (table == nullptr) {
      refuse_key(file, std::string(name.str()), into);
    }
    for (const auto& [inner, entry] : *table) {
      if (target == nullptr || !target->contains(inner.str())) {
        refuse_key(file, fmt::format("{}.{}", name.str(), inner.str()), into);
      }
      target->insert_or_assign(inner.str(), entry);
    }
  }
}

// Every key with its value; those that older configurations did not have only where they are not the default.
std::string canonical_text(toml::table root) {
  toml::table& task = *root["task"].as_table();
  if (task["kind"].value<std::string>() == default_kind) {
    task.erase("kind");
  }
  toml::table& learner = *root["learner"].as_table();
  if (learner["time_limit"].value<bool>() == false) {
    learner.erase("time_limit");
  }
  std::ostringstream every_key;
  every_key << root << '\n';
  return every_key.str();
}

void read_learner(const TomlReader& reader, LearnerConfig& learner) {
  reader.read("learner.gamma", learner.gamma, 0.0, 1.0);
  reader.read("learner.n_step", learner.n_step, 1, sil::kick_decisions);
  reader.read("learner.cut_at_exploration", learner.cut_at_exploration);
  reader.read("learner.time_limit", learner.time_limit);
  reader.read("learner.double_dqn", learner.double_dqn);
  reader.read("learner.huber", learner.huber);
  reader.read("learner.mirror", learner.augment_mirrored);
  reader.read("learner.batch", learner.batch, 2, 4096);
  reader.read("learner.replay_size", learner.replay_size, 1, 10'000'000);
  reader.read("learner.warm_up", learner.warm_up, 1, 10'000'000);
  reader.read("learner.target_period", learner.target_period, 1, 1'000'000);
  reader.read("learner.target_rate", learner.target_rate, 1e-6, 1.0);
  reader.read("learner.gradient_steps", learner.gradient_steps, 0, 100);
  reader.read("learner.int8_weights", learner.int8_weights);
  reader.read("learner.clip_norm", learner.clip_norm, 0.0, 1e6);
  reader.read("learner.prioritised", learner.prioritised);
  reader.read("learner.priority_exponent", learner.priority_exponent, 0.0, 1.0);
  reader.read("learner.priority_correction", learner.priority_correction, 0.0, 1.0);
}

Shape read_shape(const TomlReader& reader, const TaskConfig& task) {
  Shape shape;
  shape.inputs = static_cast<int>(task.inputs.size());
  shape.actions = static_cast<int>(task.actions.size());
  const auto hidden = reader.numbers("network.hidden", 2, 1.0, 1024.0);
  if (std::any_of(hidden.begin(), hidden.end(), [](double size) { return size != std::floor(size); })) {
    reader.fail("network.hidden", "must hold whole numbers");
  }
  shape.hidden1 = static_cast<int>(hidden[0]);
  shape.hidden2 = static_cast<int>(hidden[1]);
  reader.read("network.dueling", shape.dueling);
  return shape;
}

}  // namespace

std::string_view default_configuration() {
  return paper_toml;
}

Config parse_config(std::string_view text, const std::string& file, const std::vector<std::string>& changes) {
  toml::table root = parse(paper_toml, "paper.toml");
  override_with(parse(text, file), root, file);
  for (const std::string& change : changes) {
    override_with(parse(change, "--set " + change), root, "--set " + change);
  }
  Config config;
  config.name = std::filesystem::path(file).stem().string();
  config.text = canonical_text(root);
  const TomlReader reader(root, file);
  reader.read("run.episodes", config.run.episodes, 1, 10'000'000);
  reader.read("run.evaluation_period", config.run.evaluation_period, 0, 10'000'000);
  reader.read("run.validation_episodes", config.run.validation_episodes, 0, 1'000'000);
  reader.read("run.checkpoint_period", config.run.checkpoint_period, 0, 10'000'000);
  config.environments = read_environments(reader);
  config.shape = read_shape(reader, config.environments.front());
  read_learner(reader, config.learner);
  require_mirror_images(reader, config.environments.front(), config.learner.augment_mirrored);
  reader.read("optimiser.learning_rate", config.optimiser.learning_rate, 1e-7, 1.0);
  reader.read("optimiser.final_fraction", config.optimiser.final_fraction, 0.0, 1.0);
  reader.read<Course>("optimiser.schedule", config.optimiser.schedule,
                      {{"linear", Course::linear}, {"cosine", Course::cosine}});
  reader.read("optimiser.averaging", config.optimiser.averaging, 0.0, 0.999999);
  reader.read("exploration.epsilon_start", config.exploration.epsilon_start, 0.0, 1.0);
  reader.read("exploration.epsilon_end", config.exploration.epsilon_end, 0.0, 1.0);
  reader.read("exploration.decay_episodes", config.exploration.decay_episodes, 1, 10'000'000);
  reader.read<Course>("exploration.schedule", config.exploration.schedule,
                      {{"linear", Course::linear}, {"exponential", Course::exponential}});
  return config;
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  return parse_config(host::read_file(file), file.string(), changes);
}

LearnerSetup setup_of(const Config& config) {
  const TaskConfig& task = config.environments.front();
  LearnerSetup setup{.shape = config.shape,
                     .learner = config.learner,
                     .optimiser = config.optimiser,
                     .exploration = config.exploration,
                     .planned_episodes = config.run.episodes,
                     .mirror = {.factors = mirror_factors(task.inputs), .actions = {}}};
  for (int action = 0; action < config.shape.actions; ++action) {
    setup.mirror.actions.push_back(mirrored_action(task.actions, action));
  }
  return setup;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/run/config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "firmware/core/robot_ranges.hpp"
#include "firmware/host/files.hpp"
#include "paper_toml.hpp"
#include "training/run/learner_reader.hpp"
#include "training/run/task_reader.hpp"
#include "training/run/toml_reader.hpp"

namespace striker::training {

namespace {

constexpr const char* default_kind = "kick";
constexpr const char* default_learner = "dqn";

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
std::string canonical_text(toml::table root, const core::RobotDescription& robot) {
  toml::table& task = *root["task"].as_table();
  if (task["kind"].value<std::string>() == default_kind) {
    task.erase("kind");
  }
  if (robot == core::forward) {
    root.erase("robot");
  }
  toml::table& rollout = *root["rollout"].as_table();
  if (rollout["guided_share"].value<double>() == 0.0) {
    rollout.erase("guided_share");
  }
  toml::table& learner = *root["learner"].as_table();
  if (learner["time_limit"].value<bool>() == false) {
    learner.erase("time_limit");
  }
  if (learner["kind"].value<std::string>() == default_learner) {
    learner.erase("kind");
    root.erase("rollout");
    root.erase("randomise");
  }
  std::ostringstream every_key;
  every_key << root << '\n';
  return every_key.str();
}

toml::array kick_actions_of(const core::RobotDescription& robot) {
  toml::array rows;
  for (const auto& [left_m_s, right_m_s] : kick_actions(robot)) {
    rows.push_back(toml::array{left_m_s, right_m_s});
  }
  return rows;
}

Shape read_shape(const TomlReader& reader, const TaskConfig& task) {
  Shape shape;
  shape.inputs = static_cast<int>(task.inputs.size());
  shape.actions = static_cast<int>(task.actions.size());
  const auto hidden = reader.numbers("network.hidden", 1, greatest_hidden_layers, 1.0, 1024.0);
  if (std::any_of(hidden.begin(), hidden.end(), [](double size) { return size != std::floor(size); })) {
    reader.fail("network.hidden", "must hold whole numbers");
  }
  shape.hidden.assign(hidden.begin(), hidden.end());
  reader.read("network.dueling", shape.dueling);
  return shape;
}

}  // namespace

std::string_view default_configuration() {
  return paper_toml;
}

Config parse_config(std::string_view text, const std::string& file, const std::vector<std::string>& changes) {
  const toml::table defaults = parse(paper_toml, "paper.toml");
  toml::table root = defaults;
  bool names_actions = false;
  const auto read_from = [&](std::string_view part, const std::string& source) {
    const toml::table table = parse(part, source);
    override_with(table, root, source);
    names_actions = names_actions || table.at_path("task.actions");
  };
  read_from(text, file);
  for (const std::string& change : changes) {
    read_from(change, "--set " + change);
  }
  const TomlReader reader(root, file);
  const core::RobotDescription robot = read_robot_table(reader);
  if (!names_actions) {
    root["task"].as_table()->insert_or_assign("actions", kick_actions_of(robot));
  }
  Config config;
  config.name = std::filesystem::path(file).stem().string();
  config.text = canonical_text(root, robot);
  reader.read("run.episodes", config.run.episodes, 1, 10'000'000);
  reader.read("run.evaluation_period", config.run.evaluation_period, 0, 10'000'000);
  reader.read("run.validation_episodes", config.run.validation_episodes, 0, 1'000'000);
  reader.read("run.checkpoint_period", config.run.checkpoint_period, 0, 10'000'000);
  config.environments = read_environments(reader);
  config.shape = read_shape(reader, config.environments.front());
  read_learner(reader, config.learner);
  read_rollout(reader, config.rollout);
  require_mirror_images(reader, config.environments.front(), config.learner.augment_mirrored);
  read_optimiser(reader, config.optimiser);
  read_exploration(reader, config.exploration);
  require_no_other_learners_keys(reader, TomlReader(defaults, "paper.toml"), config.learner.kind);
  if (config.learner.kind == LearnerKind::rollout) {
    require_line_task(reader, config.environments.front(), config.rollout);
  }
  return config;
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  return parse_config(host::read_file(file, host::most_text_bytes), file.string(), changes);
}

std::vector<std::string> robot_changes(const core::RobotDescription& robot) {
  std::vector<std::string> changes;
  changes.reserve(core::robot_keys.size());
  for (const core::RobotKey& key : core::robot_keys) {
    changes.push_back(fmt::format("robot.{}={}", key.name, robot.*key.member));
  }
  return changes;
}

LearnerSetup setup_of(const Config& config) {
  const TaskConfig& task = config.environments.front();
  LearnerSetup setup{.shape = config.shape,
                     .learner = config.learner,
                     .rollout = config.rollout,
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

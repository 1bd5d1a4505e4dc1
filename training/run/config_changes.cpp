// SPDX-License-Identifier: Apache-2.0
#include "training/run/config_changes.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace striker::training {

namespace {

constexpr std::array<std::string_view, 17> changeable = {"run.episodes",
                                                         "run.evaluation_period",
                                                         "run.checkpoint_period",
                                                         "optimiser.learning_rate",
                                                         "optimiser.final_fraction",
                                                         "optimiser.schedule",
                                                         "exploration.epsilon_start",
                                                         "exploration.epsilon_end",
                                                         "exploration.decay_episodes",
                                                         "exploration.schedule",
                                                         "learner.batch",
                                                         "learner.clip_norm",
                                                         "learner.double_dqn",
                                                         "learner.gradient_steps",
                                                         "learner.huber",
                                                         "learner.target_period",
                                                         "learner.target_rate"};

// Of a number the shortest text that is it: 0.95.
std::string text_of(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) {
    return fmt::format("{}", *number);
  }
  std::ostringstream text;
  text << toml::node_view<const toml::node>(node);
  return text.str();
}

std::map<std::string, std::string> values_of(const std::string& text) {
  std::map<std::string, std::string> values;
  const toml::table root = toml::parse(text);
  for (const auto& [name, table] : root) {
    for (const auto& [inner, node] : *table.as_table()) {
      values[fmt::format("{}.{}", name.str(), inner.str())] = text_of(node);
    }
  }
  return values;
}

std::string shown(const std::string& value) {
  return value.empty() ? "its default" : value;
}

}  // namespace

std::vector<ChangedKey> changed_keys(const std::string& before, const std::string& now) {
  std::map<std::string, ChangedKey> keys;
  for (const auto& [key, value] : values_of(before)) {
    keys[key].before = value;
  }
  for (const auto& [key, value] : values_of(now)) {
    keys[key].now = value;
  }
  std::vector<ChangedKey> changes;
  for (auto& [key, change] : keys) {
    if (change.before != change.now) {
      change.key = key;
      changes.push_back(change);
    }
  }
  return changes;
}

bool may_change(const std::string& key) {
  return std::find(changeable.begin(), changeable.end(), key) != changeable.end();
}

void require_may_change(const std::vector<ChangedKey>& changes) {
  for (const auto& [key, before, now] : changes) {
    if (!may_change(key)) {
      throw std::runtime_error(fmt::format(
          "{} was {} and is {}, which may not change in a training that goes on: resume with the value of before, "
          "or begin anew with --force; these may change: {}",
          key, shown(before), shown(now), fmt::join(changeable, ", ")));
    }
  }
}

std::string text_of(const std::vector<ChangedKey>& changes) {
  std::string text;
  for (const auto& [key, before, now] : changes) {
    text += fmt::format("{}{} {} -> {}", text.empty() ? "" : ", ", key, shown(before), shown(now));
  }
  return text;
}

}  // namespace striker::training

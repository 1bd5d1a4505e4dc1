// SPDX-License-Identifier: Apache-2.0
// What differs between the configuration that a training was begun with and the one that it goes on with.
#pragma once

#include <string>
#include <vector>

namespace striker::training {

struct ChangedKey {
  std::string key;  // "optimiser.learning_rate"
  // The values as TOML; empty where a text leaves the key out, because it has its default.
  std::string before;
  std::string now;
};

// Of two texts of Config::text.
[[nodiscard]] std::vector<ChangedKey> changed_keys(const std::string& before, const std::string& now);

// May this key change in a training that goes on? The schedules of learning and exploration may, and what a gradient
// step does. What the network, its weights' average, the replay buffer's content or the best evaluation depend on may
// not: it would be another training's.
[[nodiscard]] bool may_change(const std::string& key);

// Throws std::runtime_error with one line that names the first key that may not change, its values, and those that
// may.
void require_may_change(const std::vector<ChangedKey>& changes);

// "optimiser.learning_rate 0.002 -> 0.0005, run.episodes 5000 -> 8000"
[[nodiscard]] std::string text_of(const std::vector<ChangedKey>& changes);

}  // namespace striker::training

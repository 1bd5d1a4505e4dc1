// SPDX-License-Identifier: Apache-2.0
#include "training/run/checkpoint/checkpoint.hpp"

#include <fmt/format.h>

#include <limits>
#include <sstream>
#include <stdexcept>

#include "firmware/host/files.hpp"
#include "training/run/checkpoint/checkpoint_values.hpp"
#include "training/run/checkpoint/learner_values.hpp"
#include "training/run/config_changes.hpp"

namespace striker::training {

namespace {

std::vector<double> reals(const std::string& list) {
  std::vector<double> values;
  std::istringstream words(list);
  for (std::string word; words >> word;) {
    values.push_back(real(word));
  }
  return values;
}

std::string list_of(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) {
    list += exact_text(value) + " ";
  }
  return list;
}

std::string history_of(const SafeTensors& checkpoint, const std::vector<ChangedKey>& changes, int episodes) {
  const auto noted = checkpoint.metadata.find("history");
  std::string history = noted == checkpoint.metadata.end() ? "" : noted->second;
  if (!changes.empty()) {
    history +=
        fmt::format("{}from episode {} on {}", history.empty() ? "" : "; ", episodes, text_of(changes));
  }
  return history;
}

RunState restore(const SafeTensors& checkpoint, const Config& config, std::uint64_t seed,
                 AnyLearner& learner) {
  const std::vector<ChangedKey> changes = changed_keys(text(checkpoint, "configuration"), config.text);
  require_may_change(changes);
  if (number<std::uint64_t>(checkpoint, "seed") != seed) {
    throw std::runtime_error(
        fmt::format("it was saved with seed {}, not {}", text(checkpoint, "seed"), seed));
  }
  const int episodes = number<int>(checkpoint, "episodes");
  if (config.run.episodes < episodes) {
    throw std::runtime_error(
        fmt::format("run.episodes = {}, but {} episodes are played; give as many or more",
                    config.run.episodes, episodes));
  }
  read_learner(checkpoint, config.learner, learner);
  const auto best_episodes = number<int>(checkpoint, "best_episodes");
  const Eigen::Index best_size = result_of(learner).values.size();
  return {.episodes = episodes,
          .recent_rewards = reals(text(checkpoint, "recent_rewards")),
          .best_episodes = best_episodes,
          .best_mean = real(text(checkpoint, "best_mean")),
          .best_values = best_episodes > 0 ? Eigen::VectorXf(matrix(checkpoint, "best", best_size, 1))
                                           : Eigen::VectorXf(),
          .history = history_of(checkpoint, changes, episodes)};
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const Config& config, std::uint64_t seed,
                     const AnyLearner& learner, const RunState& run) {
  SafeTensors checkpoint;
  add_learner(learner, config.learner, checkpoint);
  checkpoint.metadata["configuration"] = config.text;
  checkpoint.metadata["seed"] = std::to_string(seed);
  checkpoint.metadata["episodes"] = std::to_string(run.episodes);
  checkpoint.metadata["recent_rewards"] = list_of(run.recent_rewards);
  checkpoint.metadata["best_mean"] = exact_text(run.best_mean);
  checkpoint.metadata["best_episodes"] = std::to_string(run.best_episodes);
  if (!run.history.empty()) {
    checkpoint.metadata["history"] = run.history;
  }
  if (run.best_episodes > 0) {
    checkpoint.tensors.push_back(tensor_of("best", run.best_values));
  }
  host::write_file(file, write_safetensors(checkpoint));
}

RunState load_checkpoint(const std::filesystem::path& file, const Config& config, std::uint64_t seed,
                         AnyLearner& learner) {
  const SafeTensors checkpoint =
      read_safetensors(host::read_file(file, std::numeric_limits<std::size_t>::max()), file.string());
  try {
    return restore(checkpoint, config, seed, learner);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: the checkpoint cannot be resumed: {}", file.string(), error.what()));
  }
}

}  // namespace striker::training

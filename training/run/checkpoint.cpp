// SPDX-License-Identifier: Apache-2.0
#include "training/run/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "firmware/host/files.hpp"
#include "training/model/safetensors.hpp"
#include "training/run/config_changes.hpp"

namespace striker::training {

namespace {

std::string exact(double number) {
  return fmt::format("{:a}", number);
}

Tensor tensor_of(const std::string& name, const Eigen::Ref<const Eigen::MatrixXf>& matrix) {
  Tensor tensor{.name = name,
                .shape = {static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.rows())},
                .values = std::vector<float>(static_cast<std::size_t>(matrix.size()))};
  Eigen::Map<Eigen::MatrixXf>(tensor.values.data(), matrix.rows(), matrix.cols()) = matrix;
  return tensor;
}

const std::string& text(const SafeTensors& checkpoint, const std::string& key) {
  const auto found = checkpoint.metadata.find(key);
  if (found == checkpoint.metadata.end()) {
    throw std::runtime_error(fmt::format("{} is missing", key));
  }
  return found->second;
}

template <class Number>
Number number(const SafeTensors& checkpoint, const std::string& key) {
  const std::string& read = text(checkpoint, key);
  Number value{};
  const auto [end, error] = std::from_chars(read.data(), read.data() + read.size(), value);
  if (error != std::errc{} || end != read.data() + read.size()) {
    throw std::runtime_error(fmt::format("{} = \"{}\" is no number", key, read));
  }
  return value;
}

// strtod, not stod: a moment's decay may be so small that stod calls it out of range.
double real(const std::string& read) {
  char* end = nullptr;
  const double value = std::strtod(read.c_str(), &end);
  if (read.empty() || *end != '\0') {
    throw std::runtime_error(fmt::format("\"{}\" is no number", read));
  }
  return value;
}

// The tensor of this name and size, as a matrix of so many rows.
Eigen::Map<const Eigen::MatrixXf> matrix(const SafeTensors& checkpoint, const std::string& name,
                                         Eigen::Index rows, Eigen::Index columns) {
  for (const Tensor& tensor : checkpoint.tensors) {
    if (tensor.name == name && static_cast<Eigen::Index>(tensor.values.size()) == rows * columns) {
      return {tensor.values.data(), rows, columns};
    }
  }
  throw std::runtime_error(fmt::format("tensor {} of {} x {} is missing", name, columns, rows));
}

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
    list += exact(value) + " ";
  }
  return list;
}

void add_learner(const LearnerState& state, const LearnerConfig& config, SafeTensors& checkpoint) {
  checkpoint.tensors = {
      tensor_of("online", state.online.values),    tensor_of("target", state.target.values),
      tensor_of("average", state.average.values),  tensor_of("adam.mean", state.adam.mean),
      tensor_of("adam.square", state.adam.square), tensor_of("replay", state.replay.content())};
  if (config.prioritised) {
    const auto leaves = state.priorities.leaves(static_cast<std::size_t>(state.replay.size()));
    checkpoint.tensors.push_back(
        {.name = "priorities", .shape = {leaves.size()}, .values = {leaves.begin(), leaves.end()}});
  }
  checkpoint.metadata["adam.mean_decay"] = exact(state.adam.mean_decay);
  checkpoint.metadata["adam.square_decay"] = exact(state.adam.square_decay);
  checkpoint.metadata["greatest_priority"] = exact(state.priorities.greatest());
  checkpoint.metadata["replay.pushed"] = std::to_string(state.replay.pushed());
  checkpoint.metadata["decisions"] = std::to_string(state.decisions);
  checkpoint.metadata["gradient_steps"] = std::to_string(state.gradient_steps);
  checkpoint.metadata["random.choosing"] = std::to_string(state.choosing.state());
  checkpoint.metadata["random.sampling"] = std::to_string(state.sampling.state());
}

// `state` is that of a new learner of the same setup: it has the sizes.
LearnerState read_learner(const SafeTensors& checkpoint, const LearnerConfig& config, LearnerState state) {
  const Eigen::Index size = state.online.values.size();
  state.online.values = matrix(checkpoint, "online", size, 1);
  state.target.values = matrix(checkpoint, "target", size, 1);
  state.average.values = matrix(checkpoint, "average", size, 1);
  state.adam.mean = matrix(checkpoint, "adam.mean", size, 1);
  state.adam.square = matrix(checkpoint, "adam.square", size, 1);
  state.adam.mean_decay = real(text(checkpoint, "adam.mean_decay"));
  state.adam.square_decay = real(text(checkpoint, "adam.square_decay"));
  const auto pushed = number<std::int64_t>(checkpoint, "replay.pushed");
  const Eigen::Index held = std::min<Eigen::Index>(pushed, config.replay_size);
  const Eigen::Index rows = 2 * state.online.shape().inputs + 3;
  state.replay.restore(pushed, matrix(checkpoint, "replay", rows, held));
  if (config.prioritised) {
    const auto leaves = matrix(checkpoint, "priorities", held, 1);
    state.priorities.restore(std::vector<double>(leaves.data(), leaves.data() + leaves.size()),
                             real(text(checkpoint, "greatest_priority")));
  }
  state.decisions = number<std::int64_t>(checkpoint, "decisions");
  state.gradient_steps = number<std::int64_t>(checkpoint, "gradient_steps");
  state.choosing.resume(number<std::uint64_t>(checkpoint, "random.choosing"));
  state.sampling.resume(number<std::uint64_t>(checkpoint, "random.sampling"));
  return state;
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

RunState restore(const SafeTensors& checkpoint, const Config& config, std::uint64_t seed, Learner& learner) {
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
  learner.resume(read_learner(checkpoint, config.learner, learner.state()));
  const auto best_episodes = number<int>(checkpoint, "best_episodes");
  const Eigen::Index best_size = learner.result().values.size();
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
                     const Learner& learner, const RunState& run) {
  SafeTensors checkpoint;
  add_learner(learner.state(), config.learner, checkpoint);
  checkpoint.metadata["configuration"] = config.text;
  checkpoint.metadata["seed"] = std::to_string(seed);
  checkpoint.metadata["episodes"] = std::to_string(run.episodes);
  checkpoint.metadata["recent_rewards"] = list_of(run.recent_rewards);
  checkpoint.metadata["best_mean"] = exact(run.best_mean);
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
                         Learner& learner) {
  const SafeTensors checkpoint = read_safetensors(host::read_file(file), file.string());
  try {
    return restore(checkpoint, config, seed, learner);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: the checkpoint cannot be resumed: {}", file.string(), error.what()));
  }
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/run/checkpoint/learner_values.hpp"

#include <algorithm>

#include "training/run/checkpoint/checkpoint_values.hpp"

namespace striker::training {

namespace {

void add_adam(const Adam& adam, SafeTensors& checkpoint) {
  checkpoint.tensors.push_back(tensor_of("adam.mean", adam.mean));
  checkpoint.tensors.push_back(tensor_of("adam.square", adam.square));
  checkpoint.metadata["adam.mean_decay"] = exact_text(adam.mean_decay);
  checkpoint.metadata["adam.square_decay"] = exact_text(adam.square_decay);
}

void read_adam(const SafeTensors& checkpoint, Adam& adam) {
  const Eigen::Index size = adam.mean.size();
  adam.mean = matrix(checkpoint, "adam.mean", size, 1);
  adam.square = matrix(checkpoint, "adam.square", size, 1);
  adam.mean_decay = real(text(checkpoint, "adam.mean_decay"));
  adam.square_decay = real(text(checkpoint, "adam.square_decay"));
}

void add_state(const LearnerState& state, const LearnerConfig& config, SafeTensors& checkpoint) {
  checkpoint.tensors = {tensor_of("online", state.online.values), tensor_of("target", state.target.values),
                        tensor_of("average", state.average.values)};
  add_adam(state.adam, checkpoint);
  checkpoint.tensors.push_back(tensor_of("replay", state.replay.content()));
  if (config.prioritised) {
    const auto leaves = state.priorities.leaves(static_cast<std::size_t>(state.replay.size()));
    checkpoint.tensors.push_back(
        {.name = "priorities", .shape = {leaves.size()}, .values = {leaves.begin(), leaves.end()}});
  }
  checkpoint.metadata["greatest_priority"] = exact_text(state.priorities.greatest());
  checkpoint.metadata["replay.pushed"] = std::to_string(state.replay.pushed());
  checkpoint.metadata["decisions"] = std::to_string(state.decisions);
  checkpoint.metadata["gradient_steps"] = std::to_string(state.gradient_steps);
  checkpoint.metadata["random.choosing"] = std::to_string(state.choosing.state());
  checkpoint.metadata["random.sampling"] = std::to_string(state.sampling.state());
}

LearnerState read_state(const SafeTensors& checkpoint, const LearnerConfig& config, LearnerState state) {
  const Eigen::Index size = state.online.values.size();
  state.online.values = matrix(checkpoint, "online", size, 1);
  state.target.values = matrix(checkpoint, "target", size, 1);
  state.average.values = matrix(checkpoint, "average", size, 1);
  read_adam(checkpoint, state.adam);
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

void add_state(const RolloutState& state, const LearnerConfig& /*config*/, SafeTensors& checkpoint) {
  checkpoint.tensors = {tensor_of("online", state.online.values), tensor_of("average", state.average.values)};
  add_adam(state.adam, checkpoint);
  checkpoint.tensors.push_back(tensor_of("labels", state.labels.content()));
  checkpoint.metadata["labels.pushed"] = std::to_string(state.labels.pushed());
  checkpoint.metadata["decisions"] = std::to_string(state.decisions);
  checkpoint.metadata["gradient_steps"] = std::to_string(state.gradient_steps);
  checkpoint.metadata["random.exploring"] = std::to_string(state.exploring.state());
  checkpoint.metadata["random.sampling"] = std::to_string(state.sampling.state());
}

RolloutState read_state(const SafeTensors& checkpoint, const LearnerConfig& config, RolloutState state) {
  const Eigen::Index size = state.online.values.size();
  state.online.values = matrix(checkpoint, "online", size, 1);
  state.average.values = matrix(checkpoint, "average", size, 1);
  read_adam(checkpoint, state.adam);
  const auto pushed = number<std::int64_t>(checkpoint, "labels.pushed");
  const Eigen::Index held = std::min<Eigen::Index>(pushed, config.replay_size);
  state.labels.restore(pushed, matrix(checkpoint, "labels", state.labels.rows(), held));
  state.decisions = number<std::int64_t>(checkpoint, "decisions");
  state.gradient_steps = number<std::int64_t>(checkpoint, "gradient_steps");
  state.exploring.resume(number<std::uint64_t>(checkpoint, "random.exploring"));
  state.sampling.resume(number<std::uint64_t>(checkpoint, "random.sampling"));
  return state;
}

}  // namespace

void add_learner(const AnyLearner& learner, const LearnerConfig& config, SafeTensors& checkpoint) {
  std::visit([&](const auto& one) { add_state(one.state(), config, checkpoint); }, learner);
}

void read_learner(const SafeTensors& checkpoint, const LearnerConfig& config, AnyLearner& learner) {
  std::visit([&](auto& one) { one.resume(read_state(checkpoint, config, one.state())); }, learner);
}

}  // namespace striker::training

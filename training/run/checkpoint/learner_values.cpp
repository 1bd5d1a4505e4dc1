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

// What both learners have.
template <class State>
void add_shared(const State& state, SafeTensors& checkpoint) {
  checkpoint.tensors.push_back(tensor_of("online", state.online.values));
  checkpoint.tensors.push_back(tensor_of("average", state.average.values));
  add_adam(state.adam, checkpoint);
  checkpoint.metadata["decisions"] = std::to_string(state.decisions);
  checkpoint.metadata["gradient_steps"] = std::to_string(state.gradient_steps);
  checkpoint.metadata["random.sampling"] = std::to_string(state.sampling.state());
}

template <class State>
void read_shared(const SafeTensors& checkpoint, State& state) {
  const Eigen::Index size = state.online.values.size();
  state.online.values = matrix(checkpoint, "online", size, 1);
  state.average.values = matrix(checkpoint, "average", size, 1);
  read_adam(checkpoint, state.adam);
  state.decisions = number<std::int64_t>(checkpoint, "decisions");
  state.gradient_steps = number<std::int64_t>(checkpoint, "gradient_steps");
  state.sampling.resume(number<std::uint64_t>(checkpoint, "random.sampling"));
}

void add_ring(const std::string& name, const ColumnRing& ring, SafeTensors& checkpoint) {
  checkpoint.tensors.push_back(tensor_of(name, ring.content()));
  checkpoint.metadata[name + ".pushed"] = std::to_string(ring.pushed());
}

void read_ring(const SafeTensors& checkpoint, const std::string& name, const LearnerConfig& config,
               ColumnRing& ring) {
  const auto pushed = number<std::int64_t>(checkpoint, name + ".pushed");
  const Eigen::Index held = std::min<Eigen::Index>(pushed, config.replay_size);
  ring.restore(pushed, matrix(checkpoint, name, ring.rows(), held));
}

void add_state(const LearnerState& state, const LearnerConfig& config, SafeTensors& checkpoint) {
  add_shared(state, checkpoint);
  checkpoint.tensors.push_back(tensor_of("target", state.target.values));
  add_ring("replay", state.replay, checkpoint);
  if (config.prioritised) {
    const auto leaves = state.priorities.leaves(static_cast<std::size_t>(state.replay.size()));
    checkpoint.tensors.push_back(
        {.name = "priorities", .shape = {leaves.size()}, .values = {leaves.begin(), leaves.end()}});
  }
  checkpoint.metadata["greatest_priority"] = exact_text(state.priorities.greatest());
  checkpoint.metadata["random.choosing"] = std::to_string(state.choosing.state());
}

LearnerState read_state(const SafeTensors& checkpoint, const LearnerConfig& config, LearnerState state) {
  read_shared(checkpoint, state);
  state.target.values = matrix(checkpoint, "target", state.target.values.size(), 1);
  read_ring(checkpoint, "replay", config, state.replay);
  if (config.prioritised) {
    const auto leaves = matrix(checkpoint, "priorities", state.replay.size(), 1);
    state.priorities.restore(std::vector<double>(leaves.data(), leaves.data() + leaves.size()),
                             real(text(checkpoint, "greatest_priority")));
  }
  state.choosing.resume(number<std::uint64_t>(checkpoint, "random.choosing"));
  return state;
}

void add_state(const RolloutState& state, const LearnerConfig& /*config*/, SafeTensors& checkpoint) {
  add_shared(state, checkpoint);
  add_ring("labels", state.labels, checkpoint);
  checkpoint.metadata["random.exploring"] = std::to_string(state.exploring.state());
}

RolloutState read_state(const SafeTensors& checkpoint, const LearnerConfig& config, RolloutState state) {
  read_shared(checkpoint, state);
  read_ring(checkpoint, "labels", config, state.labels);
  state.exploring.resume(number<std::uint64_t>(checkpoint, "random.exploring"));
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

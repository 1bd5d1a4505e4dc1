// SPDX-License-Identifier: Apache-2.0
// Every kind of learner: what `learner.kind` chooses from. Each has a `result`, a `begin_from`, a `state` with its
// counters `decisions` and `gradient_steps`, and a `resume`.
#pragma once

#include <cstdint>
#include <variant>

#include "training/learner/dqn.hpp"
#include "training/rollout/rollout_learner.hpp"
#include "training/run/config.hpp"

namespace striker::training {

using AnyLearner = std::variant<Learner, RolloutLearner>;

[[nodiscard]] inline AnyLearner make_learner(const Config& config, std::uint64_t seed) {
  switch (config.learner.kind) {
    case LearnerKind::dqn:
      break;
    case LearnerKind::rollout:
      return RolloutLearner(setup_of(config), config.environments, seed);
  }
  return Learner(setup_of(config), seed);
}

// The network that the model will hold.
[[nodiscard]] inline Parameters result_of(const AnyLearner& learner) {
  return std::visit([](const auto& one) { return one.result(); }, learner);
}

}  // namespace striker::training

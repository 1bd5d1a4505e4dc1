// SPDX-License-Identifier: Apache-2.0
// The tables of a configuration that describe the learner: [learner], [rollout], [optimiser] and [exploration].
#pragma once

#include "training/learner/learner_config.hpp"
#include "training/run/toml_reader.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

void read_learner(const TomlReader& reader, LearnerConfig& learner);
void read_rollout(const TomlReader& reader, RolloutConfig& rollout);
void read_optimiser(const TomlReader& reader, OptimiserConfig& optimiser);
void read_exploration(const TomlReader& reader, ExplorationConfig& exploration);

// A key that only the other kind of learner reads must have its default: set, it would do nothing.
void require_no_other_learners_keys(const TomlReader& reader, const TomlReader& defaults, LearnerKind kind);

// The learner from own rollouts plays on a line; its guide searches there.
void require_line_task(const TomlReader& reader, const TaskConfig& task, const RolloutConfig& rollout);

}  // namespace striker::training

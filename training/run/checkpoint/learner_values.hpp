// SPDX-License-Identifier: Apache-2.0
// A learner's state in a checkpoint.
#pragma once

#include "training/model/safetensors.hpp"
#include "training/run/learners.hpp"

namespace striker::training {

void add_learner(const AnyLearner& learner, const LearnerConfig& config, SafeTensors& checkpoint);

// `learner` is new, of the same setup: it has the sizes.
void read_learner(const SafeTensors& checkpoint, const LearnerConfig& config, AnyLearner& learner);

}  // namespace striker::training

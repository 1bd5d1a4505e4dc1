// SPDX-License-Identifier: Apache-2.0
// What a learner has learnt and where it stands, between two episodes: a value that can be copied and kept. A
// learner of the same setup that is given it goes on to the same bits.
#pragma once

#include <cstdint>

#include "sil/world/random.hpp"
#include "training/learner/network.hpp"
#include "training/learner/priorities.hpp"
#include "training/learner/replay_buffer.hpp"

namespace striker::training {

struct LearnerState {
  Parameters online;  // exact, where the learner plays with rounded weights
  Parameters target;
  Parameters average;  // of the online network's weights, if the setup wants one
  Adam adam;
  ReplayBuffer replay;
  Priorities priorities;
  sil::Random choosing;
  sil::Random sampling;
  std::int64_t decisions = 0;
  std::int64_t gradient_steps = 0;
};

}  // namespace striker::training

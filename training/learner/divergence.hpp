// SPDX-License-Identifier: Apache-2.0
// A learner whose numbers left what float32 holds. It ends a training: from NaN nothing is learnt any more, and
// greedy play by NaN looks like that of any poor network.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace striker::training {

// Thrown by Learner::play and Learner::learn; its text is one line with episode, gradient step and what is not
// finite. The learner that threw it is of no more use.
class Divergence : public std::runtime_error {
 public:
  // `what` names the number: "the loss". Episodes count from 0, gradient steps from 1.
  Divergence(const std::string& what, int episode, std::int64_t gradient_step)
      : std::runtime_error(what + " is not finite in episode " + std::to_string(episode) +
                           ", gradient step " + std::to_string(gradient_step)) {}
};

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// How much a network's outputs are to blame for the actions that it prefers, where the value of every action is known.
//
// An action's regret r is what it gets less than the best one (at most `greatest_regret`). Two losses of a state, both
// of the differences between outputs only:
//   pairwise:  sum over the others of r(a) log(1 + exp((q(a) - q(best)) / T)): logistic, weighted by what is at stake
//              (cost-sensitive one against one, Beygelzimer et al. 2005, as a smooth loss)
//   expected:  sum over all of p(a) r(a), p = softmax(q / T): what play pays that draws its actions by p
// The first teaches from anywhere; the second is what is meant, but its gradient vanishes where p is sure and wrong.
// Beside them the squared error of the greatest output against the best value. Its gradient goes to all outputs alike:
// a function of the state alone that makes them values again and leaves the choice.
#pragma once

#include <Eigen/Core>

namespace striker::training {

struct PreferenceLoss {
  float pairwise = 0.0F;  // the weights of the three parts
  float expected = 0.0F;
  float value = 0.0F;
  float temperature = 1.0F;  // T, in units of the reward
  float greatest_regret = 1.0F;
};

struct PreferenceFigures {
  float loss = 0.0F;
  float expected_regret = 0.0F;
  float value_error = 0.0F;
};

// Of one state. Writes the gradient of the loss by the outputs; an element is an action.
PreferenceFigures differentiate(const PreferenceLoss& loss, const Eigen::Ref<const Eigen::VectorXf>& q,
                                const Eigen::Ref<const Eigen::VectorXf>& values,
                                Eigen::Ref<Eigen::VectorXf> gradient);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/preference_loss.hpp"

#include <algorithm>
#include <cmath>

namespace striker::training {

namespace {

// log(1 + exp(x)) without overflow, and its derivative.
float softplus(float x) {
  return std::max(x, 0.0F) + std::log1p(std::exp(-std::abs(x)));
}
float logistic(float x) {
  return 1.0F / (1.0F + std::exp(-x));
}

}  // namespace

PreferenceFigures differentiate(const PreferenceLoss& loss, const Eigen::Ref<const Eigen::VectorXf>& q,
                                const Eigen::Ref<const Eigen::VectorXf>& values,
                                Eigen::Ref<Eigen::VectorXf> gradient) {
  Eigen::Index best = 0;
  const float best_value = values.maxCoeff(&best);
  const float greatest_q = q.maxCoeff();
  const auto regret = [&](Eigen::Index a) { return std::min(best_value - values[a], loss.greatest_regret); };

  // `gradient` holds the softmax first.
  gradient = ((q.array() - greatest_q) / loss.temperature).exp();
  gradient /= gradient.sum();
  PreferenceFigures figures;
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    figures.expected_regret += gradient[a] * regret(a);
  }
  figures.value_error = greatest_q - best_value;
  figures.loss =
      loss.expected * figures.expected_regret + loss.value * figures.value_error * figures.value_error;

  const float to_all = 2.0F * loss.value * figures.value_error / static_cast<float>(q.size());
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    gradient[a] =
        loss.expected * gradient[a] * (regret(a) - figures.expected_regret) / loss.temperature + to_all;
  }
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    if (a != best) {
      const float lead = (q[a] - q[best]) / loss.temperature;
      const float pull = loss.pairwise * regret(a) * logistic(lead) / loss.temperature;
      figures.loss += loss.pairwise * regret(a) * softplus(lead);
      gradient[a] += pull;
      gradient[best] -= pull;
    }
  }
  return figures;
}

}  // namespace striker::training

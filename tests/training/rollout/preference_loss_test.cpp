// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/preference_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace striker::training {
namespace {

constexpr PreferenceLoss pairwise{
    .pairwise = 1.0F, .expected = 0.0F, .value = 0.0F, .temperature = 0.3F, .greatest_regret = 2.0F};
constexpr PreferenceLoss expected{
    .pairwise = 0.0F, .expected = 1.0F, .value = 0.0F, .temperature = 0.3F, .greatest_regret = 2.0F};
constexpr PreferenceLoss both{
    .pairwise = 0.1F, .expected = 1.0F, .value = 0.0F, .temperature = 1.5F, .greatest_regret = 4.0F};

// The losses of the header, in double precision and word for word.
double plain_loss(const PreferenceLoss& loss, const Eigen::VectorXd& q, const Eigen::VectorXd& values) {
  Eigen::Index best = 0;
  const double most = values.maxCoeff(&best);
  const double t = static_cast<double>(loss.temperature);
  double sum = 0.0;
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    sum += std::exp(q[a] / t);
  }
  double total = 0.0;
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    const double regret = std::min(most - values[a], static_cast<double>(loss.greatest_regret));
    total += static_cast<double>(loss.expected) * std::exp(q[a] / t) / sum * regret;
    if (a != best) {
      total += static_cast<double>(loss.pairwise) * regret * std::log(1.0 + std::exp((q[a] - q[best]) / t));
    }
  }
  return total;
}

struct State {
  Eigen::VectorXf q, values;
};

std::vector<State> some_states() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  std::vector<State> states;
  for (int i = 0; i < 200; ++i) {
    State state{.q = Eigen::VectorXf(3 + i % 2), .values = Eigen::VectorXf(3 + i % 2)};
    for (Eigen::Index a = 0; a < state.q.size(); ++a) {
      state.q[a] = normal(random);
      state.values[a] = 3.0F * normal(random);
    }
    states.push_back(state);
  }
  return states;
}

class PreferenceLosses : public testing::TestWithParam<PreferenceLoss> {};

TEST_P(PreferenceLosses, TheirGradientIsTheFiniteDifference) {
  constexpr double step = 1e-5;
  for (const auto& [q, values] : some_states()) {
    Eigen::VectorXf gradient(q.size());
    const PreferenceFigures figures = differentiate(GetParam(), q, values, gradient);
    const Eigen::VectorXd at = q.cast<double>();
    EXPECT_NEAR(static_cast<double>(figures.loss), plain_loss(GetParam(), at, values.cast<double>()), 1e-4);
    EXPECT_NEAR(static_cast<double>(gradient.sum()), 0.0, 1e-5);
    for (Eigen::Index a = 0; a < q.size(); ++a) {
      Eigen::VectorXd more = at;
      Eigen::VectorXd less = at;
      more[a] += step;
      less[a] -= step;
      const double slope = (plain_loss(GetParam(), more, values.cast<double>()) -
                            plain_loss(GetParam(), less, values.cast<double>())) /
                           (2.0 * step);
      EXPECT_NEAR(static_cast<double>(gradient[a]), slope, 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rollout, PreferenceLosses, testing::Values(pairwise, expected, both));

// It moves all outputs alike, as far as the greatest one is from the best value.
TEST(PreferenceLosses, TheValueLeavesTheChoice) {
  for (const auto& [q, values] : some_states()) {
    Eigen::VectorXf gradient(q.size());
    const PreferenceFigures figures =
        differentiate({.value = 0.5F, .temperature = 1.0F, .greatest_regret = 1.0F}, q, values, gradient);
    const float error = q.maxCoeff() - values.maxCoeff();
    EXPECT_FLOAT_EQ(figures.value_error, error);
    EXPECT_FLOAT_EQ(figures.loss, 0.5F * error * error);
    EXPECT_NEAR(static_cast<double>(gradient.sum()), static_cast<double>(error), 1e-5);
    EXPECT_FLOAT_EQ(gradient.maxCoeff(), gradient.minCoeff());
  }
}

// Outputs that leave float's exponents nothing to say.
TEST(PreferenceLosses, AreFiniteForAnyOutputs) {
  const Eigen::Vector3f values(1.0F, -4.0F, 3.0F);
  Eigen::VectorXf gradient(3);
  for (const float size : {1e3F, 1e6F, 1e30F}) {
    const Eigen::Vector3f q(size, -size, 0.0F);
    EXPECT_TRUE(std::isfinite(differentiate(both, q, values, gradient).loss));
    EXPECT_TRUE(gradient.allFinite());
  }
}

}  // namespace
}  // namespace striker::training

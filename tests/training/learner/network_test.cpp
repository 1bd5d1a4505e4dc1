// SPDX-License-Identifier: Apache-2.0
// The network's forward and backward pass, and Adam.
#include "training/learner/network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

constexpr int batch = 16;

Eigen::MatrixXf some_states(unsigned seed, int inputs) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Eigen::MatrixXf states(inputs, batch);
  for (Eigen::Index i = 0; i < states.size(); ++i) {
    states.data()[i] = normal(random);
  }
  return states;
}

// The Q values in double precision, neuron by neuron: what the matrix code must agree with.
std::vector<double> plain_q(const Shape& shape, const Eigen::VectorXd& parameters,
                            const Eigen::VectorXd& state) {
  std::vector<double> values(state.begin(), state.end());
  const double* weight = parameters.data();
  const std::vector<int> widths = shape.widths();
  const std::size_t layers = widths.size() - 1;
  for (std::size_t l = 0; l < layers; ++l) {
    const auto inputs = static_cast<std::size_t>(widths[l]);
    const auto outputs = static_cast<std::size_t>(widths[l + 1]);
    std::vector<double> next;
    for (std::size_t j = 0; j < outputs; ++j) {
      double sum = weight[inputs * outputs + j];
      for (std::size_t i = 0; i < inputs; ++i) {
        sum += weight[i * outputs + j] * values[i];
      }
      next.push_back(l + 1 < layers ? std::max(0.0, sum) : sum);
    }
    weight += (inputs + 1) * outputs;
    values = next;
  }
  if (shape.dueling) {
    const double value = values.back();
    values.pop_back();
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / shape.actions;
    for (double& q : values) {
      q += value - mean;
    }
  }
  return values;
}

class Networks : public testing::TestWithParam<Shape> {};

TEST_P(Networks, SingleAndBatchAgreeWithPlainLoops) {
  const Shape shape = GetParam();
  const Parameters parameters = some_parameters(1, shape);
  const Parameters plain_network = folded(parameters);
  EXPECT_FALSE(plain_network.shape().dueling);
  const Eigen::MatrixXf states = some_states(2, shape.inputs);
  Pass pass(shape, batch);
  forward(parameters, states, pass);
  Actor actor(shape);
  Actor folded_actor(plain_network.shape());
  for (int i = 0; i < batch; ++i) {
    const Features state = states.col(i);
    const auto plain = plain_q(shape, parameters.values.cast<double>(), state.cast<double>());
    const Eigen::VectorXf single = actor.values(parameters, state);
    const Eigen::VectorXf from_folded = folded_actor.values(plain_network, state);
    for (int k = 0; k < shape.actions; ++k) {
      ASSERT_NEAR(single(k), plain[static_cast<std::size_t>(k)], 1e-4);
      ASSERT_NEAR(pass.q(k, i), plain[static_cast<std::size_t>(k)], 1e-4);
      ASSERT_NEAR(from_folded(k), plain[static_cast<std::size_t>(k)], 1e-4);
    }
  }
}

TEST_P(Networks, GradientIsThatOfFiniteDifferences) {
  const Shape shape = GetParam();
  const Parameters parameters = some_parameters(3, shape);
  const Eigen::MatrixXf states = some_states(4, shape.inputs);
  const Eigen::MatrixXd q_gradient = Eigen::MatrixXd::Random(shape.actions, batch);
  Pass pass(shape, batch);
  Eigen::VectorXf gradient(parameters.values.size());
  forward(parameters, states, pass);
  backward(parameters, states, pass, q_gradient.cast<float>(), gradient);

  // The loss sum(q_gradient * q) in double precision has this gradient by the Q values.
  const auto loss = [&](const Eigen::VectorXd& at) {
    double sum = 0.0;
    for (int i = 0; i < batch; ++i) {
      const auto q = plain_q(shape, at, states.col(i).cast<double>());
      for (int k = 0; k < shape.actions; ++k) {
        sum += q_gradient(k, i) * q[static_cast<std::size_t>(k)];
      }
    }
    return sum;
  };
  constexpr double step = 1e-6;
  const double scale = gradient.cwiseAbs().maxCoeff();
  for (Eigen::Index p = 0; p < gradient.size(); p += 7) {
    Eigen::VectorXd at = parameters.values.cast<double>();
    at(p) += step;
    const double above = loss(at);
    at(p) -= 2.0 * step;
    const double below = loss(at);
    ASSERT_NEAR(gradient(p), (above - below) / (2.0 * step), 1e-4 * scale) << "parameter " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Networks,
                         testing::Values(Shape{}, Shape{.dueling = true},
                                         Shape{.inputs = 12, .hidden = {40, 20}, .actions = 5},
                                         Shape{.inputs = 7, .hidden = {30}},
                                         Shape{.inputs = 8, .hidden = {24, 1, 18}, .dueling = true}),
                         [](const auto& tested) {
                           return std::to_string(tested.param.inputs) +
                                  (tested.param.dueling ? "Dueling" : "");
                         });

TEST(Network, AdamIsTheOneOfThePaper) {
  constexpr Eigen::Index size = 5;
  Eigen::VectorXf parameters = Eigen::VectorXf::Zero(size);
  Adam adam(size);
  double mean = 0.0;
  double square = 0.0;
  double expected = 0.0;
  for (int t = 1; t <= 50; ++t) {
    const double g = std::sin(t) + 0.3;
    adam.step(parameters, Eigen::VectorXf::Constant(size, static_cast<float>(g)), 0.01);
    mean = 0.9 * mean + 0.1 * g;
    square = 0.999 * square + 0.001 * g * g;
    const double unbiased = mean / (1.0 - std::pow(0.9, t));
    expected -= 0.01 * unbiased / (std::sqrt(square / (1.0 - std::pow(0.999, t))) + 1e-8);
  }
  EXPECT_NEAR(parameters(0), expected, 1e-5);
  EXPECT_NEAR(parameters(size - 1), expected, 1e-5);
}

TEST(Network, OfEqualValuesTheFirstIsChosen) {
  EXPECT_EQ(greedy_action(Eigen::Vector3f(1.0F, 1.0F, 0.0F)), 0);
  EXPECT_EQ(greedy_action(Eigen::Vector3f(0.0F, 1.0F, 1.0F)), 1);
  EXPECT_EQ(greedy_action(Eigen::Vector3f(0.0F, 1.0F, 2.0F)), 2);
}

}  // namespace
}  // namespace striker::training

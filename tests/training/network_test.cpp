// The network's forward and backward pass, and Adam.
#include "network.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.hpp"

namespace striker::training {
namespace {

constexpr int batch = 16;

StateBatch some_states(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  StateBatch states(state_elements, batch);
  for (Eigen::Index i = 0; i < states.size(); ++i) {
    states.data()[i] = normal(random);
  }
  return states;
}

// The Q values in double precision, neuron by neuron: what the matrix code must agree with.
std::vector<double> plain_q(const Eigen::VectorXd& parameters, const Eigen::VectorXd& state) {
  std::vector<double> values(state.begin(), state.end());
  for (int l = 0; l < layer_count; ++l) {
    const auto inputs = static_cast<std::size_t>(widths[static_cast<std::size_t>(l)]);
    const auto outputs = static_cast<std::size_t>(widths[static_cast<std::size_t>(l) + 1]);
    const double* weight = parameters.data() + layer_offset(l);
    std::vector<double> next;
    for (std::size_t j = 0; j < outputs; ++j) {
      double sum = weight[inputs * outputs + j];
      for (std::size_t i = 0; i < inputs; ++i) {
        sum += weight[i * outputs + j] * values[i];
      }
      next.push_back(l + 1 < layer_count ? std::max(0.0, sum) : sum);
    }
    values = next;
  }
  return values;
}

TEST(Network, SingleAndBatchAgreeWithPlainLoops) {
  const Parameters parameters = some_parameters(1);
  const StateBatch states = some_states(2);
  BatchPass pass(batch);
  forward(parameters, states, pass);
  for (int i = 0; i < batch; ++i) {
    const Features state = states.col(i);
    const auto plain = plain_q(parameters.cast<double>(), state.cast<double>());
    const QValues single = q_values(parameters, state);
    for (int k = 0; k < actions; ++k) {
      ASSERT_NEAR(single(k), plain[static_cast<std::size_t>(k)], 1e-4);
      ASSERT_NEAR(pass.q(k, i), plain[static_cast<std::size_t>(k)], 1e-4);
    }
  }
}

TEST(Network, GradientIsThatOfFiniteDifferences) {
  const Parameters parameters = some_parameters(3);
  const StateBatch states = some_states(4);
  const Eigen::MatrixXd q_gradient = Eigen::MatrixXd::Random(actions, batch);
  BatchPass pass(batch);
  Parameters gradient;
  forward(parameters, states, pass);
  backward(parameters, states, pass, q_gradient.cast<float>(), gradient);

  // The loss sum(q_gradient * q) in double precision has this gradient by the Q values.
  const auto loss = [&](const Eigen::VectorXd& at) {
    double sum = 0.0;
    for (int i = 0; i < batch; ++i) {
      const auto q = plain_q(at, states.col(i).cast<double>());
      for (int k = 0; k < actions; ++k) {
        sum += q_gradient(k, i) * q[static_cast<std::size_t>(k)];
      }
    }
    return sum;
  };
  constexpr double step = 1e-6;
  const double scale = gradient.cwiseAbs().maxCoeff();
  for (int p = 0; p < parameter_count; p += 7) {
    Eigen::VectorXd at = parameters.cast<double>();
    at(p) += step;
    const double above = loss(at);
    at(p) -= 2.0 * step;
    const double below = loss(at);
    ASSERT_NEAR(gradient(p), (above - below) / (2.0 * step), 1e-4 * scale) << "parameter " << p;
  }
}

TEST(Network, AdamIsTheOneOfThePaper) {
  Parameters parameters = Parameters::Zero();
  Adam adam;
  double mean = 0.0;
  double square = 0.0;
  double expected = 0.0;
  for (int t = 1; t <= 50; ++t) {
    const double g = std::sin(t) + 0.3;
    adam.step(parameters, Parameters::Constant(static_cast<float>(g)), 0.01);
    mean = 0.9 * mean + 0.1 * g;
    square = 0.999 * square + 0.001 * g * g;
    const double unbiased = mean / (1.0 - std::pow(0.9, t));
    expected -= 0.01 * unbiased / (std::sqrt(square / (1.0 - std::pow(0.999, t))) + 1e-8);
  }
  EXPECT_NEAR(parameters(0), expected, 1e-5);
  EXPECT_NEAR(parameters(parameter_count - 1), expected, 1e-5);
}

TEST(Network, OfEqualValuesTheFirstIsChosen) {
  EXPECT_EQ(greedy_action(QValues(1.0F, 1.0F, 0.0F)), 0);
  EXPECT_EQ(greedy_action(QValues(0.0F, 1.0F, 1.0F)), 1);
  EXPECT_EQ(greedy_action(QValues(0.0F, 1.0F, 2.0F)), 2);
}

}  // namespace
}  // namespace striker::training

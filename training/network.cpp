// GCC 12 warns of a loop inside Eigen that only a batch of one would reach.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Waggressive-loop-optimizations"
#endif

#include "network.hpp"

#include <cmath>

namespace striker::training {

namespace {

// The gradient passes where ReLU let the activation through.
template <class Activations, class Gradient>
void cut(const Activations& activations, Gradient& gradient) {
  gradient.array() *= (activations.array() > 0.0F).template cast<float>();
}

}  // namespace

BatchPass::BatchPass(int batch)
    : hidden1(widths[1], batch),
      gradient1(widths[1], batch),
      hidden2(widths[2], batch),
      gradient2(widths[2], batch),
      q(actions, batch) {}

QValues q_values(const Parameters& parameters, const Features& state) {
  const BiasVector<0> hidden1 = (weights<0>(parameters) * state + biases<0>(parameters)).cwiseMax(0.0F);
  const BiasVector<1> hidden2 = (weights<1>(parameters) * hidden1 + biases<1>(parameters)).cwiseMax(0.0F);
  return weights<2>(parameters) * hidden2 + biases<2>(parameters);
}

int greedy_action(const QValues& q) {
  int best = 0;
  q.maxCoeff(&best);
  return best;
}

void forward(const Parameters& parameters, const StateBatch& states, BatchPass& pass) {
  pass.hidden1.noalias() = weights<0>(parameters) * states;
  pass.hidden1 = (pass.hidden1.colwise() + biases<0>(parameters)).cwiseMax(0.0F);
  pass.hidden2.noalias() = weights<1>(parameters) * pass.hidden1;
  pass.hidden2 = (pass.hidden2.colwise() + biases<1>(parameters)).cwiseMax(0.0F);
  pass.q.noalias() = weights<2>(parameters) * pass.hidden2;
  pass.q.colwise() += biases<2>(parameters);
}

void backward(const Parameters& parameters, const StateBatch& states, BatchPass& pass,
              const QBatch& q_gradient, Parameters& gradient) {
  weights<2>(gradient).noalias() = q_gradient * pass.hidden2.transpose();
  biases<2>(gradient) = q_gradient.rowwise().sum();

  pass.gradient2.noalias() = weights<2>(parameters).transpose() * q_gradient;
  cut(pass.hidden2, pass.gradient2);
  weights<1>(gradient).noalias() = pass.gradient2 * pass.hidden1.transpose();
  biases<1>(gradient) = pass.gradient2.rowwise().sum();

  pass.gradient1.noalias() = weights<1>(parameters).transpose() * pass.gradient2;
  cut(pass.hidden1, pass.gradient1);
  weights<0>(gradient).noalias() = pass.gradient1 * states.transpose();
  biases<0>(gradient) = pass.gradient1.rowwise().sum();
}

void Adam::step(Parameters& parameters, const Parameters& gradient, double learning_rate) {
  constexpr double beta_mean = 0.9;
  constexpr double beta_square = 0.999;
  constexpr float epsilon = 1e-8F;
  mean_decay_ *= beta_mean;
  square_decay_ *= beta_square;
  mean_ += static_cast<float>(1.0 - beta_mean) * (gradient - mean_);
  square_ += static_cast<float>(1.0 - beta_square) * (gradient.cwiseAbs2() - square_);
  const auto rate = static_cast<float>(learning_rate / (1.0 - mean_decay_));
  const auto scale = static_cast<float>(1.0 / (1.0 - square_decay_));
  parameters.array() -= rate * mean_.array() / ((scale * square_.array()).sqrt() + epsilon);
}

}  // namespace striker::training

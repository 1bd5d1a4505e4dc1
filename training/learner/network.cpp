// SPDX-License-Identifier: Apache-2.0
#include "training/learner/network.hpp"

#include <cmath>

namespace striker::training {

namespace {

// The gradient passes where ReLU let the activation through.
void cut(const Eigen::MatrixXf& activations, Eigen::MatrixXf& gradient) {
  gradient.array() = (activations.array() > 0.0F).select(gradient.array(), 0.0F);
}

// Q = V + A - mean(A), with V in the last row.
void join_duel(const Shape& shape, Pass& pass) {
  for (Eigen::Index i = 0; i < pass.q.cols(); ++i) {
    const auto advantages = pass.output.col(i).head(shape.actions);
    pass.q.col(i) = advantages.array() + (pass.output(shape.actions, i) - advantages.mean());
  }
}

}  // namespace

std::vector<int> Shape::widths() const {
  std::vector<int> widths{inputs};
  widths.insert(widths.end(), hidden.begin(), hidden.end());
  widths.push_back(outputs());
  return widths;
}

Parameters::Parameters(const Shape& shape) : shape_(shape) {
  const std::vector<int> widths = shape.widths();
  int size = 0;
  for (std::size_t layer = 0; layer + 1 < widths.size(); ++layer) {
    const int columns = widths[layer];
    const int rows = widths[layer + 1];
    places_[layer] = {.weights = size, .biases = size + rows * columns, .rows = rows, .columns = columns};
    size += rows * (columns + 1);
  }
  values = Eigen::VectorXf::Zero(size);
}

Eigen::Map<Eigen::MatrixXf> Parameters::weights(int layer) {
  const Place& place = places_[static_cast<std::size_t>(layer)];
  return {values.data() + place.weights, place.rows, place.columns};
}

Eigen::Map<const Eigen::MatrixXf> Parameters::weights(int layer) const {
  const Place& place = places_[static_cast<std::size_t>(layer)];
  return {values.data() + place.weights, place.rows, place.columns};
}

Eigen::Map<Eigen::VectorXf> Parameters::biases(int layer) {
  const Place& place = places_[static_cast<std::size_t>(layer)];
  return {values.data() + place.biases, place.rows};
}

Eigen::Map<const Eigen::VectorXf> Parameters::biases(int layer) const {
  const Place& place = places_[static_cast<std::size_t>(layer)];
  return {values.data() + place.biases, place.rows};
}

void round_to_int8(const Parameters& from, Parameters& to) {
  to.values = from.values;
  for (int layer = 0; layer < from.shape().layers(); ++layer) {
    auto weights = to.weights(layer);
    const double largest = std::max(static_cast<double>(weights.cwiseAbs().maxCoeff()), 1e-9);
    const auto scale = static_cast<float>(std::exp2(std::floor(std::log2(127.0 / largest))));
    weights.array() = (weights.array() * scale).rint() * (1.0F / scale);
  }
}

Parameters folded(const Parameters& parameters) {
  Shape shape = parameters.shape();
  if (!shape.dueling) {
    return parameters;
  }
  shape.dueling = false;
  Parameters plain(shape);
  const int last = shape.layers() - 1;
  for (int layer = 0; layer < last; ++layer) {
    plain.weights(layer) = parameters.weights(layer);
    plain.biases(layer) = parameters.biases(layer);
  }
  const auto weights = parameters.weights(last);
  const auto biases = parameters.biases(last);
  const auto advantages = weights.topRows(shape.actions);
  plain.weights(last) = advantages.rowwise() + (weights.row(shape.actions) - advantages.colwise().mean());
  plain.biases(last) =
      biases.head(shape.actions).array() + (biases(shape.actions) - biases.head(shape.actions).mean());
  return plain;
}

Pass::Pass(const Shape& shape, int batch)
    : output(shape.outputs(), batch), q(shape.actions, batch), output_gradient(shape.outputs(), batch) {
  for (const int neurons : shape.hidden) {
    hidden.emplace_back(neurons, batch);
    hidden_gradients.emplace_back(neurons, batch);
  }
}

void forward(const Parameters& parameters, const Eigen::Ref<const Eigen::MatrixXf>& states, Pass& pass) {
  const auto hidden = [&](std::size_t l, const auto& inputs) {
    const auto layer = static_cast<int>(l);
    pass.hidden[l].noalias() = parameters.weights(layer) * inputs;
    pass.hidden[l] = (pass.hidden[l].colwise() + parameters.biases(layer)).cwiseMax(0.0F);
  };
  hidden(0, states);
  for (std::size_t l = 1; l < pass.hidden.size(); ++l) {
    hidden(l, pass.hidden[l - 1]);
  }
  const int last = parameters.shape().layers() - 1;
  pass.output.noalias() = parameters.weights(last) * pass.hidden.back();
  pass.output.colwise() += parameters.biases(last);
  if (parameters.shape().dueling) {
    join_duel(parameters.shape(), pass);
  } else {
    pass.q = pass.output;
  }
}

void backward(const Parameters& parameters, const Eigen::Ref<const Eigen::MatrixXf>& states, Pass& pass,
              const Eigen::MatrixXf& q_gradient, Eigen::Ref<Eigen::VectorXf> gradient) {
  const Shape& shape = parameters.shape();
  if (shape.dueling) {
    for (Eigen::Index i = 0; i < q_gradient.cols(); ++i) {
      const float sum = q_gradient.col(i).sum();
      pass.output_gradient.col(i).head(shape.actions) =
          q_gradient.col(i).array() - sum / static_cast<float>(shape.actions);
      pass.output_gradient(shape.actions, i) = sum;
    }
  } else {
    pass.output_gradient = q_gradient;
  }
  float* at = gradient.data();
  const auto layer_gradient = [&at](const Eigen::MatrixXf& of_sums, const auto& inputs) {
    Eigen::Map<Eigen::MatrixXf> weights(at, of_sums.rows(), inputs.rows());
    weights.noalias() = of_sums * inputs.transpose();
    Eigen::Map<Eigen::VectorXf> biases(at + weights.size(), of_sums.rows());
    biases.noalias() = of_sums.rowwise().sum();
    at += weights.size() + biases.size();
  };
  auto& gradients = pass.hidden_gradients;
  for (std::size_t l = gradients.size(); l-- > 0;) {
    const Eigen::MatrixXf& next = l + 1 < gradients.size() ? gradients[l + 1] : pass.output_gradient;
    gradients[l].noalias() = parameters.weights(static_cast<int>(l) + 1).transpose() * next;
    cut(pass.hidden[l], gradients[l]);
  }
  layer_gradient(gradients[0], states);
  for (std::size_t l = 1; l < gradients.size(); ++l) {
    layer_gradient(gradients[l], pass.hidden[l - 1]);
  }
  layer_gradient(pass.output_gradient, pass.hidden.back());
}

auto Actor::values(const Parameters& parameters, const Features& state) -> Eigen::MatrixXf::ColXpr {
  forward(parameters, state, pass_);
  return pass_.q.col(0);
}

Adam::Adam(Eigen::Index size) : mean(Eigen::VectorXf::Zero(size)), square(Eigen::VectorXf::Zero(size)) {}

void Adam::step(Eigen::VectorXf& parameters, const Eigen::VectorXf& gradient, double learning_rate) {
  constexpr double beta_mean = 0.9;
  constexpr double beta_square = 0.999;
  constexpr float epsilon = 1e-8F;
  mean_decay *= beta_mean;
  square_decay *= beta_square;
  mean += static_cast<float>(1.0 - beta_mean) * (gradient - mean);
  square += static_cast<float>(1.0 - beta_square) * (gradient.cwiseAbs2() - square);
  const auto rate = static_cast<float>(learning_rate / (1.0 - mean_decay));
  const auto scale = static_cast<float>(1.0 / (1.0 - square_decay));
  parameters.array() -= rate * mean.array() / ((scale * square.array()).sqrt() + epsilon);
}

}  // namespace striker::training

// The Q network: 6 -> 64 -> 64 -> 3, fully connected, ReLU between, float32.
//
// All parameters of a network lie in one vector, so that copying, Adam and hashing are one line each;
// `weights<L>` and `biases<L>` look at a layer's part of it. Every size but the batch's is known at compile
// time; nothing here allocates once a `BatchPass` has been sized.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "state.hpp"

namespace striker::training {

// The network's shape: change it here and nowhere else.
inline constexpr std::array widths = {state_elements, 64, 64, 3};
inline constexpr int layer_count = static_cast<int>(widths.size()) - 1;
inline constexpr int actions = widths.back();

// Where layer L begins in the parameters: its weights (outputs x inputs, by columns), then its biases.
constexpr int layer_offset(int layer) {
  int offset = 0;
  for (std::size_t l = 0; l < static_cast<std::size_t>(layer); ++l) {
    offset += (widths[l] + 1) * widths[l + 1];
  }
  return offset;
}

inline constexpr int parameter_count = layer_offset(layer_count);
using Parameters = Eigen::Matrix<float, parameter_count, 1>;

template <int L>
using WeightMatrix = Eigen::Matrix<float, widths[L + 1], widths[L]>;
template <int L>
using BiasVector = Eigen::Matrix<float, widths[L + 1], 1>;

template <int L>
auto weights(const Parameters& parameters) {
  return Eigen::Map<const WeightMatrix<L>>(parameters.data() + layer_offset(L));
}
template <int L>
auto weights(Parameters& parameters) {
  return Eigen::Map<WeightMatrix<L>>(parameters.data() + layer_offset(L));
}
template <int L>
auto biases(const Parameters& parameters) {
  return Eigen::Map<const BiasVector<L>>(parameters.data() + layer_offset(L) +
                                         WeightMatrix<L>::SizeAtCompileTime);
}
template <int L>
auto biases(Parameters& parameters) {
  return Eigen::Map<BiasVector<L>>(parameters.data() + layer_offset(L) + WeightMatrix<L>::SizeAtCompileTime);
}

using QValues = Eigen::Matrix<float, actions, 1>;

[[nodiscard]] QValues q_values(const Parameters& parameters, const Features& state);

// The action with the greatest value; of equals, the first.
[[nodiscard]] int greedy_action(const QValues& q);

// A batch: one sample a column.
using StateBatch = Eigen::Matrix<float, state_elements, Eigen::Dynamic>;
using QBatch = Eigen::Matrix<float, actions, Eigen::Dynamic>;

// What a forward pass computes, and room for the backward pass.
struct BatchPass {
  explicit BatchPass(int batch);
  Eigen::Matrix<float, widths[1], Eigen::Dynamic> hidden1, gradient1;
  Eigen::Matrix<float, widths[2], Eigen::Dynamic> hidden2, gradient2;
  QBatch q;
};

void forward(const Parameters& parameters, const StateBatch& states, BatchPass& pass);

// The gradient of a loss by the parameters, from its gradient by the Q values. `pass` is the forward pass
// over the same states.
void backward(const Parameters& parameters, const StateBatch& states, BatchPass& pass,
              const QBatch& q_gradient, Parameters& gradient);

// Adam (Kingma and Ba 2015) with its usual constants: beta 0.9 and 0.999, epsilon 1e-8.
class Adam {
 public:
  void step(Parameters& parameters, const Parameters& gradient, double learning_rate);

 private:
  Parameters mean_ = Parameters::Zero();
  Parameters square_ = Parameters::Zero();
  double mean_decay_ = 1.0;
  double square_decay_ = 1.0;
};

}  // namespace striker::training

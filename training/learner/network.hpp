// SPDX-License-Identifier: Apache-2.0
// The Q network: inputs -> one to three hidden layers -> actions, fully connected, ReLU between, float32.
//
// All parameters of a network lie in one vector, so that copying, Adam and hashing are one line each;
// `weights` and `biases` look at a layer's part of it. Sizes are fixed when an object is made: nothing here
// allocates after that.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "training/task/state.hpp"

namespace striker::training {

inline constexpr std::size_t greatest_hidden_layers = 3;  // as the firmware's header has it

struct Shape {
  int inputs = 6;
  std::vector<int> hidden = {64, 64};  // the neurons of one to three layers
  int actions = 3;
  // Dueling (Wang et al. 2016): the last layer has one more neuron, V, and Q = V + A - mean(A).
  bool dueling = false;

  [[nodiscard]] int outputs() const { return actions + (dueling ? 1 : 0); }
  [[nodiscard]] int layers() const { return static_cast<int>(hidden.size()) + 1; }
  // From the inputs to the outputs.
  [[nodiscard]] std::vector<int> widths() const;
  bool operator==(const Shape&) const = default;
};

class Parameters {
 public:
  explicit Parameters(const Shape& shape);  // all 0

  [[nodiscard]] const Shape& shape() const { return shape_; }

  // Layer 0 to shape().layers() - 1: outputs x inputs, and one bias an output.
  [[nodiscard]] Eigen::Map<Eigen::MatrixXf> weights(int layer);
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXf> weights(int layer) const;
  [[nodiscard]] Eigen::Map<Eigen::VectorXf> biases(int layer);
  [[nodiscard]] Eigen::Map<const Eigen::VectorXf> biases(int layer) const;

  // Layer by layer, its weights by columns, then its biases.
  Eigen::VectorXf values;

  bool operator==(const Parameters& other) const { return shape_ == other.shape_ && values == other.values; }

 private:
  struct Place {
    int weights, biases, rows, columns;
  };

  Shape shape_;
  std::array<Place, greatest_hidden_layers + 1> places_{};
};

// Are all of them finite? Costs a pass over them at the memory's speed (0 times NaN or infinity is NaN).
[[nodiscard]] inline bool all_finite(const Eigen::VectorXf& values) {
  return (0.0F * values).sum() == 0.0F;
}

// The same function without the dueling head, which folds into the last layer.
[[nodiscard]] Parameters folded(const Parameters& parameters);

// Each layer's weights rounded to multiples of a power of two, the least with which they fit -127 to 127: as
// an export with int8 weights stores them, so that it loses nothing. Biases stay.
void round_to_int8(const Parameters& from, Parameters& to);

// The action with the greatest value; of equals, the first.
template <class Values>
[[nodiscard]] int greedy_action(const Values& q) {
  Eigen::Index best = 0;
  q.maxCoeff(&best);
  return static_cast<int>(best);
}

// What a forward pass computes, a sample a column, and room for the backward pass.
struct Pass {
  Pass(const Shape& shape, int batch);
  std::vector<Eigen::MatrixXf> hidden, hidden_gradients;  // one a hidden layer
  Eigen::MatrixXf output, q, output_gradient;
};

void forward(const Parameters& parameters, const Eigen::Ref<const Eigen::MatrixXf>& states, Pass& pass);

// The gradient of a loss by the parameters, from its gradient by the Q values. `pass` is the forward pass
// over the same states.
void backward(const Parameters& parameters, const Eigen::Ref<const Eigen::MatrixXf>& states, Pass& pass,
              const Eigen::MatrixXf& q_gradient, Eigen::Ref<Eigen::VectorXf> gradient);

// For single states, with its own room.
class Actor {
 public:
  explicit Actor(const Shape& shape) : pass_(shape, 1) {}
  [[nodiscard]] int choose(const Parameters& parameters, const Features& state) {
    return greedy_action(values(parameters, state));
  }
  [[nodiscard]] auto values(const Parameters& parameters, const Features& state) -> Eigen::MatrixXf::ColXpr;

 private:
  Pass pass_;
};

// Greedy play by a network, as `play` (training/task/environment.hpp) asks for a rule. One thread may use it.
class GreedyRule {
 public:
  explicit GreedyRule(const Parameters& parameters) : parameters_(&parameters), actor_(parameters.shape()) {}
  template <class E>
  [[nodiscard]] int operator()(const E& seen) {
    return actor_.choose(*parameters_, seen.features());
  }

 private:
  const Parameters* parameters_;
  Actor actor_;
};

// Adam (Kingma and Ba 2015) with its usual constants: beta 0.9 and 0.999, epsilon 1e-8.
struct Adam {
  explicit Adam(Eigen::Index size);
  void step(Eigen::VectorXf& parameters, const Eigen::VectorXf& gradient, double learning_rate);

  Eigen::VectorXf mean, square;
  double mean_decay = 1.0, square_decay = 1.0;  // beta^t
};

}  // namespace striker::training

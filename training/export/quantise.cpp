// SPDX-License-Identifier: Apache-2.0
#include "training/export/quantise.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace striker::training {

namespace {

// Play may meet a little more than calibration did.
constexpr double activation_margin = 1.1;
constexpr int q_fraction_bits = 8;  // the output's sum >> shift is Q in 1/256
constexpr double greatest_bias = 2147483647.0;
constexpr int greatest_shift = 30;

// The range is symmetric: without -2^7 and -2^15.
double greatest_weight(WeightType type) {
  return type == WeightType::int8 ? 127.0 : 32767.0;
}

struct FloatLayer {
  Eigen::MatrixXd weights;
  Eigen::VectorXd biases;
};

std::vector<FloatLayer> layers_of(const Parameters& parameters) {
  std::vector<FloatLayer> layers;
  layers.reserve(static_cast<std::size_t>(parameters.shape().layers()));
  for (int layer = 0; layer < parameters.shape().layers(); ++layer) {
    layers.push_back({parameters.weights(layer).cast<double>(), parameters.biases(layer).cast<double>()});
  }
  return layers;
}

// What each layer holds, a column a calibration state: inputs, hidden activations, Q.
std::vector<Eigen::MatrixXd> float_play(const std::vector<FloatLayer>& layers, const StateInputs& inputs,
                                        std::span<const RawState> states) {
  std::vector<Eigen::MatrixXd> held{Eigen::MatrixXd(inputs.size(), states.size())};
  for (std::size_t i = 0; i < states.size(); ++i) {
    held[0].col(static_cast<Eigen::Index>(i)) = features_of(inputs, states[i]).cast<double>();
  }
  for (std::size_t l = 0; l < layers.size(); ++l) {
    Eigen::MatrixXd sums = (layers[l].weights * held.back()).colwise() + layers[l].biases;
    held.push_back(l + 1 < layers.size() ? Eigen::MatrixXd(sums.cwiseMax(0.0)) : sums);
  }
  return held;
}

// The greatest power of two that keeps `greatest` times it within `limit`.
int exponent_for(double greatest, double limit) {
  return static_cast<int>(std::floor(std::log2(limit / std::max(greatest, 1e-9))));
}

int activation_exponent(const Eigen::MatrixXd& held) {
  return exponent_for(activation_margin * held.cwiseAbs().maxCoeff(),
                      static_cast<double>(greatest_activation));
}

// raw * unit * 2^exponent as a multiplier of at most 20 bits and a shift.
InputScale input_scale(double unit, int exponent) {
  constexpr double greatest_multiplier = 1048576.0;
  int shift = 40;
  while (std::round(std::ldexp(unit, exponent + shift)) > greatest_multiplier) {
    --shift;
  }
  return {.multiplier = static_cast<std::int32_t>(std::lround(std::ldexp(unit, exponent + shift))),
          .shift = shift};
}

std::vector<InputScale> input_scales(const StateInputs& inputs, int exponent) {
  std::vector<InputScale> scales;
  for (const StateInput& input : inputs) {
    const ElementFacts& facts = facts_of(input.element);
    scales.push_back(input_scale(1.0 / facts.raw_per_value / facts.unit, exponent));
  }
  return scales;
}

// How the rounding error of one column spreads over the columns after it (Frantar et al. 2023, "GPTQ"): the
// upper Cholesky factor of the inverse of the inputs' second moments over the calibration states. The last
// column stands for the bias, whose input is 1.
Eigen::MatrixXd error_feedback(const Eigen::MatrixXd& inputs) {
  constexpr double damping = 1e-4;  // of the mean second moment: neurons that calibration hardly met
  Eigen::MatrixXd extended(inputs.rows() + 1, inputs.cols());
  extended << inputs, Eigen::RowVectorXd::Ones(inputs.cols());
  Eigen::MatrixXd moments = extended * extended.transpose() / static_cast<double>(inputs.cols());
  moments.diagonal().array() += damping * moments.diagonal().mean();
  return moments.inverse().llt().matrixU();
}

// Rounds the weights column by column; what each loses, the columns after it and the bias make good. Nothing
// if a number does not fit its type.
std::optional<IntegerLayer> integer_layer(const FloatLayer& layer, const Eigen::MatrixXd& feedback,
                                          double weight_limit, int weight_exponent, int input_exponent,
                                          int shift) {
  const Eigen::Index columns = layer.weights.cols();
  Eigen::MatrixXd left(layer.weights.rows(), columns + 1);
  left << layer.weights, layer.biases;
  left *= std::ldexp(1.0, weight_exponent);
  Eigen::MatrixXd rounded(left.rows(), columns);
  for (Eigen::Index column = 0; column < columns; ++column) {
    rounded.col(column) = left.col(column).array().round().matrix();
    const Eigen::VectorXd lost = (left.col(column) - rounded.col(column)) / feedback(column, column);
    left.rightCols(columns - column) -= lost * feedback.row(column).tail(columns - column);
  }
  const Eigen::VectorXd biases = (std::ldexp(1.0, input_exponent) * left.col(columns)).array().round();
  if (rounded.cwiseAbs().maxCoeff() > weight_limit || biases.cwiseAbs().maxCoeff() > greatest_bias) {
    return std::nullopt;
  }
  IntegerLayer integers;
  integers.inputs = static_cast<std::size_t>(columns);
  integers.shift = shift;
  for (const double weight : rounded.reshaped<Eigen::RowMajor>()) {
    integers.weights.push_back(static_cast<std::int16_t>(weight));
  }
  for (const double bias : biases) {
    integers.biases.push_back(static_cast<std::int32_t>(bias));
  }
  return integers;
}

// One number of a layer: weights(row, column), or biases(row) if `column` is its number of inputs.
struct Culprit {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  double times_too_large = 0.0;
};

// What keeps a layer from fitting at the least scale there is, 2^exponent: the number that is the farthest beyond
// its type, or else the largest share of the largest sum.
Culprit culprit_of(const FloatLayer& layer, double weight_limit, int exponent, int input_exponent) {
  const Eigen::Index columns = layer.weights.cols();
  const double greatest_input = static_cast<double>(greatest_activation);
  Eigen::MatrixXd share(layer.weights.rows(), columns + 1);
  share << layer.weights.cwiseAbs() * std::max(greatest_input / greatest_bias, 1.0 / weight_limit),
      layer.biases.cwiseAbs() * std::ldexp(1.0 / greatest_bias, input_exponent);
  share *= std::ldexp(1.0, exponent);
  Culprit culprit;
  culprit.times_too_large = share.maxCoeff(&culprit.row, &culprit.column);
  return culprit;
}

// How to come by a layer that fits.
std::string way_out(bool hidden, bool dead, Eigen::Index states) {
  if (hidden && dead) {
    return fmt::format(
        "that neuron was active in none of {} states of play: with its weights and its bias set to 0 the network "
        "chooses the same in all of them",
        states);
  }
  return hidden ? "train with a lower optimiser.learning_rate, or divide that neuron's weights and bias by a "
                  "power of two and multiply by it the weights that read the neuron"
                : "train with a lower optimiser.learning_rate";
}

[[noreturn]] void refuse_layer(std::size_t number, bool hidden, const FloatLayer& layer,
                               const Culprit& culprit, const Eigen::MatrixXd& inputs, WeightType type) {
  const auto [row, column, times] = culprit;
  const bool bias = column == layer.weights.cols();
  const double value = bias ? layer.biases(row) : layer.weights(row, column);
  const double most = ((layer.weights.row(row) * inputs).array() + layer.biases(row)).maxCoeff();
  throw std::runtime_error(fmt::format(
      "layer {} cannot be quantised to {} and 32-bit sums: tensor {}.{}, row {}{}, is {:g}, {}; {}", number,
      name_of(type), 2 * (number - 1), bias ? "bias" : "weight", row,
      bias ? "" : fmt::format(", column {}", column), value,
      times > 1.0 ? fmt::format("{:.3g} times what fits", times) : "the most of a sum that does not fit",
      way_out(hidden, most <= 0.0, inputs.cols())));
}

// Appends the layer at the greatest weight scale that passes the proof; returns that scale's exponent.
int append_layer(IntegerNetwork& network, const FloatLayer& layer, bool hidden, const Eigen::MatrixXd& inputs,
                 int input_exponent, int output_exponent) {
  const int least_shift = hidden ? 1 : 0;
  const Eigen::MatrixXd feedback = error_feedback(inputs);
  const double limit = greatest_weight(network.weights);
  int exponent = exponent_for(layer.weights.cwiseAbs().maxCoeff(), limit);
  exponent = std::min(exponent, greatest_shift + output_exponent - input_exponent);
  for (;; --exponent) {
    const int shift = input_exponent + exponent - output_exponent;
    if (shift < least_shift) {
      refuse_layer(network.layers.size() + 1, hidden, layer,
                   culprit_of(layer, limit, least_shift + output_exponent - input_exponent, input_exponent),
                   inputs, network.weights);
    }
    const auto integers = integer_layer(layer, feedback, limit, exponent, input_exponent, shift);
    if (!integers) {
      continue;
    }
    network.layers.push_back(*integers);
    if (bound_layers(network, hidden).back().fits()) {
      return exponent;
    }
    network.layers.pop_back();
  }
}

// Range, headroom and error of each layer, over the calibration states.
void measure(Quantised& result, const std::vector<Eigen::MatrixXd>& held, std::span<const RawState> states) {
  const std::vector<LayerBound> bounds = bound_layers(result.network);
  const double count = static_cast<double>(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto values = layer_values(result.network, states[i]);
    for (std::size_t l = 0; l < values.size(); ++l) {
      const bool hidden = l + 1 < values.size();
      const double limit = hidden ? static_cast<double>(greatest_activation) : 0x1p31;
      LayerReport& report = result.layers[l];
      const int exponent = report.activation_exponent + (hidden ? 0 : result.network.layers[l].shift);
      for (std::size_t neuron = 0; neuron < values[l].size(); ++neuron) {
        const double real = held[l + 1](static_cast<Eigen::Index>(neuron), static_cast<Eigen::Index>(i));
        const double error = std::abs(std::ldexp(values[l][neuron], -exponent) - real);
        report.mean_error += error / (count * static_cast<double>(values[l].size()));
        report.greatest_error = std::max(report.greatest_error, error);
        report.range_used = std::max(report.range_used, std::abs(values[l][neuron]) / limit);
      }
    }
  }
  for (std::size_t l = 0; l < bounds.size(); ++l) {
    result.layers[l].headroom_bits = 31.0 - std::log2(static_cast<double>(bounds[l].worst_sum));
  }
}

}  // namespace

Quantised quantise(const Parameters& parameters, const StateInputs& inputs,
                   std::span<const RawState> calibration, WeightType weights) {
  const std::vector<FloatLayer> layers = layers_of(parameters);
  const std::vector<Eigen::MatrixXd> held = float_play(layers, inputs, calibration);
  Quantised result;
  result.network.weights = weights;
  result.input_exponent = activation_exponent(held[0]);
  result.network.input_scales = input_scales(inputs, result.input_exponent);
  int input_exponent = result.input_exponent;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const bool hidden = l + 1 < layers.size();
    LayerReport report;
    report.activation_exponent = hidden ? activation_exponent(held[l + 1]) : q_fraction_bits;
    report.weight_exponent =
        append_layer(result.network, layers[l], hidden, held[l], input_exponent, report.activation_exponent);
    input_exponent = report.activation_exponent;
    result.layers.push_back(report);
  }
  measure(result, held, calibration);
  return result;
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// The network's kernel beside Eigen's fixed-size float, same shape and weights, on this processor with AVX2:
//
//   kernel_rival time          both in turns; the medians of 401 rounds in ns, and of the rounds' ratios
//   kernel_rival network|eigen 200 inferences of one, for a tool that counts its instructions
#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string_view>
#include <vector>

#include "firmware/policy/built_in.hpp"
#include "tests/policy/tested_infer.hpp"

namespace {

using namespace striker::policy;

constexpr const auto& trained = striker::policy::built_in;
using Shape = std::remove_cvref_t<decltype(trained)>;
using Raw = std::array<std::int32_t, Shape::inputs>;

template <std::size_t Inputs, std::size_t Outputs>
struct FloatLayer {
  Eigen::Matrix<float, Outputs, Inputs> weights;
  Eigen::Matrix<float, Outputs, 1> biases;

  template <class Weight>
  explicit FloatLayer(const Layer<Inputs, Outputs, Weight>& layer) {
    for (std::size_t row = 0; row < Outputs; ++row) {
      for (std::size_t column = 0; column < Inputs; ++column) {
        weights(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
            static_cast<float>(layer.weights[row][column]) / 4096.0F;
      }
      biases(static_cast<Eigen::Index>(row)) = static_cast<float>(layer.biases[row]) / 16'777'216.0F;
    }
  }
};

template <std::size_t n>
const FloatLayer float_layer(trained.layer<n>());

using FloatInput = Eigen::Matrix<float, Shape::inputs, 1>;

// What the float network chooses, from what layer n reads.
template <std::size_t n, class Vector>
[[gnu::always_inline]] inline int action_after(const Vector& in) {
  if constexpr (n < Shape::hidden_layers) {
    const Eigen::Matrix<float, Shape::widths[n + 1], 1> out =
        (float_layer<n>.weights * in + float_layer<n>.biases).cwiseMax(0.0F);
    return action_after<n + 1>(out);
  } else {
    const Eigen::Matrix<float, Shape::actions, 1> q = float_layer<n>.weights * in + float_layer<n>.biases;
    Eigen::Index action = 0;
    q.maxCoeff(&action);
    return static_cast<int>(action);
  }
}

}  // namespace

// Counted by their names.
extern "C" [[gnu::noinline]] int counted_inference(const Raw& raw) {
  return tested_infer<trained>(raw).action;
}

extern "C" [[gnu::noinline]] int counted_eigen(const FloatInput& input) {
  return action_after<0>(input);
}

namespace {

constexpr std::size_t draws = 256;

template <class Infer>
double nanoseconds_each(Infer infer_one) {
  constexpr int repetitions = 2048;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < repetitions; ++i) {
    infer_one(static_cast<std::size_t>(i) % draws);
  }
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
         repetitions;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "time";
  std::mt19937 random(1);
  std::vector<Raw> raws(draws);
  std::vector<FloatInput> inputs(draws);
  for (std::size_t i = 0; i < draws; ++i) {
    for (std::size_t k = 0; k < Shape::inputs; ++k) {
      raws[i][k] = static_cast<std::int32_t>(random()) >> 12;
      inputs[i](static_cast<Eigen::Index>(k)) = static_cast<float>(raws[i][k]) / 1e6F;
    }
  }
  long actions = 0;
  const auto ours = [&](std::size_t i) { actions += counted_inference(raws[i]); };
  const auto eigen = [&](std::size_t i) { actions += counted_eigen(inputs[i]); };
  if (what != "time") {
    for (std::size_t i = 0; i < 200; ++i) {
      what == "eigen" ? eigen(i) : ours(i);
    }
  } else {
    std::vector<double> ours_ns, eigen_ns, ratios;
    for (int round = 0; round < 401; ++round) {
      ours_ns.push_back(nanoseconds_each(ours));
      eigen_ns.push_back(nanoseconds_each(eigen));
      ratios.push_back(eigen_ns.back() / ours_ns.back());
    }
    std::printf("ns %.1f\neigen ns %.1f\nratio %.2f\n", median(ours_ns), median(eigen_ns), median(ratios));
  }
  std::fprintf(stderr, "%ld\n", actions);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "training/run/checkpoint/checkpoint_values.hpp"

#include <cstdlib>
#include <vector>

namespace striker::training {

std::string exact_text(double number) {
  return fmt::format("{:a}", number);
}

// strtod, not stod: a moment's decay may be so small that stod calls it out of range.
double real(const std::string& read) {
  char* end = nullptr;
  const double value = std::strtod(read.c_str(), &end);
  if (read.empty() || *end != '\0') {
    throw std::runtime_error(fmt::format("\"{}\" is no number", read));
  }
  return value;
}

Tensor tensor_of(const std::string& name, const Eigen::Ref<const Eigen::MatrixXf>& matrix) {
  Tensor tensor{.name = name,
                .shape = {static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.rows())},
                .values = std::vector<float>(static_cast<std::size_t>(matrix.size()))};
  Eigen::Map<Eigen::MatrixXf>(tensor.values.data(), matrix.rows(), matrix.cols()) = matrix;
  return tensor;
}

Eigen::Map<const Eigen::MatrixXf> matrix(const SafeTensors& checkpoint, const std::string& name,
                                         Eigen::Index rows, Eigen::Index columns) {
  for (const Tensor& tensor : checkpoint.tensors) {
    if (tensor.name == name && static_cast<Eigen::Index>(tensor.values.size()) == rows * columns) {
      return {tensor.values.data(), rows, columns};
    }
  }
  throw std::runtime_error(fmt::format("tensor {} of {} x {} is missing", name, columns, rows));
}

const std::string& text(const SafeTensors& checkpoint, const std::string& key) {
  const auto found = checkpoint.metadata.find(key);
  if (found == checkpoint.metadata.end()) {
    throw std::runtime_error(fmt::format("{} is missing", key));
  }
  return found->second;
}

}  // namespace striker::training

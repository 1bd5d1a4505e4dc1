// SPDX-License-Identifier: Apache-2.0
// Numbers and matrices in a checkpoint, which is safetensors: each is written exactly, and what is missing or damaged
// is a std::runtime_error that says which.
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <charconv>
#include <stdexcept>
#include <string>

#include "training/model/safetensors.hpp"

namespace striker::training {

[[nodiscard]] std::string exact_text(double number);  // a hexadecimal float
[[nodiscard]] double real(const std::string& read);

[[nodiscard]] Tensor tensor_of(const std::string& name, const Eigen::Ref<const Eigen::MatrixXf>& matrix);
// The tensor of this name and size, as a matrix of so many rows.
[[nodiscard]] Eigen::Map<const Eigen::MatrixXf> matrix(const SafeTensors& checkpoint, const std::string& name,
                                                       Eigen::Index rows, Eigen::Index columns);

[[nodiscard]] const std::string& text(const SafeTensors& checkpoint, const std::string& key);

template <class Number>
[[nodiscard]] Number number(const SafeTensors& checkpoint, const std::string& key) {
  const std::string& read = text(checkpoint, key);
  Number value{};
  const auto [end, error] = std::from_chars(read.data(), read.data() + read.size(), value);
  if (error != std::errc{} || end != read.data() + read.size()) {
    throw std::runtime_error(fmt::format("{} = \"{}\" is no number", key, read));
  }
  return value;
}

}  // namespace striker::training

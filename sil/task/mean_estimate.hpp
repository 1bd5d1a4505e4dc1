// SPDX-License-Identifier: Apache-2.0
// A mean over episodes with its standard error, as every report of this project gives it.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace striker::sil {

struct MeanEstimate {
  double mean = 0.0;
  double standard_error = 0.0;  // s / sqrt(n) with the sample's s (n - 1); 0 of fewer than two values
};

[[nodiscard]] inline MeanEstimate mean_estimate(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  MeanEstimate estimate;
  for (const double value : values) {
    estimate.mean += value / count;
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - estimate.mean) * (value - estimate.mean);
  }
  estimate.standard_error = values.size() > 1 ? std::sqrt(squares / (count - 1.0) / count) : 0.0;
  return estimate;
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/league/intervals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sil/task/mean_estimate.hpp"

namespace striker::sil {
namespace {

constexpr double normal = 1.959963985;  // 97.5 %

// Of 1 to 10 degrees of freedom; beyond, Cornish and Fisher's expansion does.
constexpr std::array few_degrees = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                    2.4469,  2.3646, 2.3060, 2.2622, 2.2281};

}  // namespace

double student_t(int degrees) {
  if (degrees <= static_cast<int>(few_degrees.size())) {
    return few_degrees[static_cast<std::size_t>(degrees - 1)];
  }
  const double n = degrees;
  const double z2 = normal * normal;
  return normal * (1.0 + (z2 + 1.0) / (4.0 * n) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n) +
                   (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n));
}

Mean mean_of(std::span<const double> values) {
  const MeanEstimate estimate = mean_estimate(values);
  Mean mean{.value = estimate.mean, .half_width = {}};
  if (values.size() > 1) {
    mean.half_width = student_t(static_cast<int>(values.size()) - 1) * estimate.standard_error;
  }
  return mean;
}

Share share_of(int part, int whole) {
  if (whole == 0) {
    return {};
  }
  const double n = whole;
  const double p = part / n;
  const double z2 = normal * normal;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half_width = normal / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {.value = p, .low = std::max(0.0, middle - half_width), .high = std::min(1.0, middle + half_width)};
}

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// How a learning rate or an exploration changes in the course of a training.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "training/learner/learner_config.hpp"

namespace striker::training {

// From start to end as `share` goes from 0 to 1, and end after that.
[[nodiscard]] inline double course(Course form, double start, double end, double share) {
  const double at = std::clamp(share, 0.0, 1.0);
  switch (form) {
    case Course::exponential:
      return start * std::pow(std::max(end, 1e-6) / std::max(start, 1e-6), at);
    case Course::cosine:
      return end + (start - end) * 0.5 * (1.0 + std::cos(std::numbers::pi * at));
    case Course::linear:
      break;
  }
  return start + (end - start) * at;
}

[[nodiscard]] inline double share_of(int part, int whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// Prioritised replay (Schaul et al. 2016, proportional variant): a transition is drawn with a probability
// proportional to (|TD error| + epsilon)^alpha, in O(log n) from a tree of sums.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace striker::training {

class Priorities {
 public:
  Priorities(std::size_t capacity, double alpha)
      : alpha_(alpha), leaves_(std::bit_ceil(capacity)), sums_(2 * leaves_, 0.0) {}

  // A new transition is as urgent as the most urgent so far, so that each is seen soon.
  void insert(std::size_t place) { set(place, greatest_); }

  void update(std::size_t place, double td_error) {
    constexpr double epsilon = 1e-3;  // so that no transition is forgotten
    const double priority = std::pow(std::abs(td_error) + epsilon, alpha_);
    greatest_ = std::max(greatest_, priority);
    set(place, priority);
  }

  // The place where the running sum of priorities passes `share` (0 to 1) of the whole.
  [[nodiscard]] std::size_t at(double share) const {
    double rest = share * sums_[1];
    std::size_t node = 1;
    while (node < leaves_) {
      node *= 2;
      // A right branch without priorities is never entered, whatever rounding says.
      if (rest >= sums_[node] && sums_[node + 1] > 0.0) {
        rest -= sums_[node];
        ++node;
      }
    }
    return node - leaves_;
  }

  [[nodiscard]] double probability(std::size_t place) const { return sums_[leaves_ + place] / sums_[1]; }

  // For checkpoints: the leaves, and the greatest priority so far.
  [[nodiscard]] std::span<const double> leaves(std::size_t count) const {
    return std::span(sums_).subspan(leaves_, count);
  }
  [[nodiscard]] double greatest() const { return greatest_; }
  void restore(std::span<const double> leaves, double greatest) {
    for (std::size_t place = 0; place < leaves.size(); ++place) {
      set(place, leaves[place]);
    }
    greatest_ = greatest;
  }

 private:
  void set(std::size_t place, double priority) {
    std::size_t node = leaves_ + place;
    sums_[node] = static_cast<double>(static_cast<float>(priority));  // as a checkpoint keeps it
    while (node > 1) {
      node /= 2;
      sums_[node] = sums_[2 * node] + sums_[2 * node + 1];
    }
  }

  double alpha_;
  std::size_t leaves_;
  std::vector<double> sums_;  // sums_[1] is the root, the leaves are the second half
  double greatest_ = 1.0;
};

}  // namespace striker::training

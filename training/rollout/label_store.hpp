// SPDX-License-Identifier: Apache-2.0
// Labelled states, the newest ones.
#pragma once

#include <Eigen/Core>

#include "training/learner/column_ring.hpp"

namespace striker::training {

// A column: features, the value of each action, the weight.
class LabelStore : public ColumnRing {
 public:
  LabelStore(Eigen::Index inputs, Eigen::Index actions, Eigen::Index capacity)
      : ColumnRing(inputs + actions + 1, capacity), inputs_(inputs), actions_(actions) {}

  // `weight` makes up for how often such states are labelled.
  template <class Features, class Values>
  void push(const Features& features, const Values& values, float weight) {
    column(claim()) << features, values, weight;
  }

  [[nodiscard]] auto features(Eigen::Index place) const { return columns().col(place).head(inputs_); }
  [[nodiscard]] auto values(Eigen::Index place) const {
    return columns().col(place).segment(inputs_, actions_);
  }
  [[nodiscard]] float weight(Eigen::Index place) const { return columns()(inputs_ + actions_, place); }

 private:
  Eigen::Index inputs_;
  Eigen::Index actions_;
};

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// Labelled states: a ring that forgets the oldest. A label is a column of one matrix, so that a sample is one stretch
// of memory and a checkpoint one tensor: features, the value of each action, the weight.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace striker::training {

class LabelStore {
 public:
  LabelStore(Eigen::Index inputs, Eigen::Index actions, Eigen::Index capacity)
      : inputs_(inputs), actions_(actions), columns_(Eigen::MatrixXf::Zero(inputs + actions + 1, capacity)) {}

  // `weight` makes up for how often such states are labelled.
  template <class Features, class Values>
  void push(const Features& features, const Values& values, float weight) {
    columns_.col(pushed_ % columns_.cols()) << features, values, weight;
    ++pushed_;
  }
  [[nodiscard]] Eigen::Index size() const { return pushed_ < columns_.cols() ? pushed_ : columns_.cols(); }

  [[nodiscard]] auto features(Eigen::Index place) const { return columns_.col(place).head(inputs_); }
  [[nodiscard]] auto values(Eigen::Index place) const {
    return columns_.col(place).segment(inputs_, actions_);
  }
  [[nodiscard]] float weight(Eigen::Index place) const { return columns_(inputs_ + actions_, place); }

  // For checkpoints.
  [[nodiscard]] std::int64_t pushed() const { return pushed_; }
  [[nodiscard]] Eigen::Index rows() const { return columns_.rows(); }
  [[nodiscard]] auto content() const { return columns_.leftCols(size()); }
  void restore(std::int64_t pushed, const Eigen::Ref<const Eigen::MatrixXf>& content) {
    pushed_ = pushed;
    columns_.leftCols(size()) = content;
  }

 private:
  Eigen::Index inputs_;
  Eigen::Index actions_;
  Eigen::MatrixXf columns_;
  std::int64_t pushed_ = 0;
};

}  // namespace striker::training

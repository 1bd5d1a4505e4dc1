// SPDX-License-Identifier: Apache-2.0
// A ring that forgets the oldest. What is kept is a column of one matrix, so that a sample is one stretch of memory and
// a checkpoint one tensor. What a column holds is the derived class's.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace striker::training {

class ColumnRing {
 public:
  ColumnRing(Eigen::Index rows, Eigen::Index capacity) : columns_(Eigen::MatrixXf::Zero(rows, capacity)) {}

  [[nodiscard]] Eigen::Index size() const { return pushed_ < columns_.cols() ? pushed_ : columns_.cols(); }

  // For checkpoints.
  [[nodiscard]] std::int64_t pushed() const { return pushed_; }
  [[nodiscard]] Eigen::Index rows() const { return columns_.rows(); }
  [[nodiscard]] auto content() const { return columns_.leftCols(size()); }
  void restore(std::int64_t pushed, const Eigen::Ref<const Eigen::MatrixXf>& content) {
    pushed_ = pushed;
    columns_.leftCols(size()) = content;
  }

 protected:
  [[nodiscard]] const Eigen::MatrixXf& columns() const { return columns_; }
  // The next place, whose column is to be filled.
  Eigen::Index claim() { return pushed_++ % columns_.cols(); }
  [[nodiscard]] auto column(Eigen::Index place) { return columns_.col(place); }

 private:
  Eigen::MatrixXf columns_;
  std::int64_t pushed_ = 0;
};

}  // namespace striker::training

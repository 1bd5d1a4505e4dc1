// SPDX-License-Identifier: Apache-2.0
// The processes of one `mpirun`, on one machine or several: who does what, and files brought to the first.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace striker::training {

class Ranks {
 public:
  // Joins the others if this process was started by Open MPI's mpirun; else it is alone.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }

  // To be called by all, each with its own files: those that the first has not (no common file system) are
  // written there.
  void collect(const std::vector<std::filesystem::path>& files) const;

  // To be called by all: the sum of what each gives.
  [[nodiscard]] int sum(int value) const;

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// How far a controller's choices agree with the float network's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "training/learner/network.hpp"

namespace striker::training {

struct TakenDecision {
  RawState state;
  int action = 0;
};

// Where the float network's best action leads the second best by more than this, it is clear.
inline constexpr double clear_gap = 0.02;

struct Agreement {
  std::size_t states = 0;
  std::size_t clear_states = 0;
  double agreement = 1.0;        // the share of all states in which both choose the same
  double clear_agreement = 1.0;  // the share of the clear ones
  double mean_regret = 0.0;      // float Q of the best action minus float Q of the one taken
};

[[nodiscard]] Agreement agreement(const Parameters& parameters, const StateInputs& inputs,
                                  std::span<const TakenDecision> decisions);

// The decisions before contact of a file that striker-sil writes: CSV, whole numbers, with the header
//   episode,decision,before_contact,action,
// and then a column for each input of the network. Throws std::runtime_error that names file and line.
[[nodiscard]] std::vector<TakenDecision> load_decisions(const std::filesystem::path& file,
                                                        const Shape& shape);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// How far a controller's choices agree with the float network's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "training/learner/network.hpp"

namespace striker::training {

struct TakenDecision {
  RawState state;
  int action = 0;
};

// Where the float network's best action leads the second best by more than this, it is clear.
inline constexpr double clear_gap = 0.02;

// Over no states there is no share and no mean: then these are empty.
struct Agreement {
  std::size_t states = 0;
  std::size_t clear_states = 0;
  std::optional<double> agreement;        // the share of all states in which both choose the same, 0 to 1
  std::optional<double> clear_agreement;  // the share of the clear ones
  std::optional<double> mean_regret;  // float Q of the best action minus float Q of the one taken, at least 0
};

[[nodiscard]] Agreement agreement(const Parameters& parameters, const StateInputs& inputs,
                                  std::span<const TakenDecision> decisions);

// A share or mean as text with `digits` decimals; "none" where it is empty.
[[nodiscard]] std::string share_text(const std::optional<double>& share, int digits);

// The first line of a file of decisions, without its end, for a network of these inputs:
//   episode,decision,before_contact,action,
// and then a column for each input, named as the firmware names it (policy::row_of); "@1" is the value a decision
// ago. Throws std::runtime_error for an input that no controller has.
[[nodiscard]] std::string decisions_header(const StateInputs& inputs);

// The decisions before contact of a file that striker-sil writes: CSV, whole numbers, with that header. Lines may
// end as on Windows. Throws std::runtime_error that names file, line and column: the header is another one, a line
// is not such a row or was cut off, or no decision is before contact.
[[nodiscard]] std::vector<TakenDecision> load_decisions(const std::filesystem::path& file,
                                                        const StateInputs& inputs, int actions);

}  // namespace striker::training

// SPDX-License-Identifier: Apache-2.0
// From a trained model to the policy that the firmware takes, and how far it is from the model.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "training/export/comparison/agreement.hpp"
#include "training/export/comparison/reward_difference.hpp"
#include "training/export/export_header.hpp"
#include "training/export/quantise.hpp"
#include "training/model/model.hpp"

namespace striker::training {

struct Export {
  ExportedPolicy policy;
  Quantised quantised;
  Agreement agreement;  // of the integer network with the float one, on states that calibration did not see
  std::size_t calibration_states = 0;
  RewardDifference reward;
};

// Of episodes that an export plays, each twice: for calibration states and golden vectors greedily and at random; all
// of them, of which the others compare the two networks' rewards. 3 to 10 s.
inline constexpr int export_calibration_episodes = 300;
inline constexpr int export_episodes = export_calibration_episodes + 500;

// Plays episodes that neither training nor evaluation meets, greedily and at random, for calibration states
// and golden vectors. Throws std::runtime_error for a model that the firmware could not
// serve (firmware_limits.hpp) or that cannot be quantised (quantise.hpp). Calls `played` after each of
// export_episodes.
[[nodiscard]] Export export_model(
    const Model& model, const TaskConfig& task, WeightType weights = WeightType::int16,
    const EpisodePlayed& played = [] {});

// The integer network of that export alone, without comparisons: half a second. Throws as export_model.
[[nodiscard]] IntegerNetwork integers_of(const Model& model, const TaskConfig& task,
                                         WeightType weights = WeightType::int16);

// The name of a policy whose header is written to `file`: its name without extension. Throws
// std::runtime_error if that is no lower-case C++ identifier.
[[nodiscard]] std::string policy_name_of(const std::filesystem::path& file);

}  // namespace striker::training

// From a trained model to everything that striker-export writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "training/export/agreement.hpp"
#include "training/export/export_header.hpp"
#include "training/export/quantise.hpp"
#include "training/export/reward_difference.hpp"
#include "training/model/model.hpp"

namespace striker::training {

struct Export {
  ExportedPolicy policy;
  Quantised quantised;
  Agreement agreement;  // of the integer network with the float one, on states that calibration did not see
  std::size_t calibration_states = 0;
  RewardDifference reward;
};

// Plays episodes that neither training nor evaluation meets, greedily and at random, for calibration states
// and golden vectors. Throws std::runtime_error for a model that the firmware could not serve.
[[nodiscard]] Export export_model(const Model& model, const EnvConfig& task,
                                  WeightType weights = WeightType::int16);

// The exported header: striker::policy::NAME below a comment that says what it is.
[[nodiscard]] std::string header_of(const Export& exported, const Model& model, const std::string& name);

// The name of a policy whose header is written to `file`: its name without extension. Throws
// std::runtime_error if that is no lower-case C++ identifier.
[[nodiscard]] std::string policy_name_of(const std::filesystem::path& file);

// The same figures as JSON.
[[nodiscard]] std::string report_of(const Export& exported, const Model& model);

}  // namespace striker::training

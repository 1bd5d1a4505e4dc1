// SPDX-License-Identifier: Apache-2.0
// Writes the weight header that firmware/policy/policy.hpp describes: the only thing that training hands to
// the firmware.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "training/export/golden_vectors.hpp"
#include "training/export/integer_network.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

struct ExportedPolicy {
  std::uint32_t configuration_hash = 0;  // FNV-1a of the training configuration's text
  std::int32_t decision_period_ms = 50;
  StateInputs inputs;
  bool one_sided = false;  // the header's `mirrored`
  IntegerNetwork network;
  std::vector<SetPoint> actions;  // the header's `set_points`, there in whole mm/s
  std::vector<GoldenVector> golden_vectors;
};

// The identity as `identity_of` in firmware/policy/proof.hpp specifies it.
[[nodiscard]] std::uint32_t identity_of(const ExportedPolicy& policy);

// The policy is striker::policy::NAME, a C++ identifier. `notes` become the comment on top, a line each, of
// at most 105 characters. The text depends on the arguments alone: no dates, no paths.
[[nodiscard]] std::string header_text(const ExportedPolicy& policy, const std::string& name,
                                      const std::vector<std::string>& notes);

}  // namespace striker::training

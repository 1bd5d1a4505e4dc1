// SPDX-License-Identifier: Apache-2.0
// An experiment's summary as tables for programs. training/README.md explains every column.
#pragma once

#include <string>
#include <vector>

#include "training/experiment/experiment_summary.hpp"

namespace striker::training {

// summary.csv: a row a variant.
[[nodiscard]] std::string summary_csv(const std::vector<VariantSummary>& summaries);

// curves.csv: a row a variant and point of its curve.
[[nodiscard]] std::string curves_csv(const std::vector<VariantSummary>& summaries);

}  // namespace striker::training

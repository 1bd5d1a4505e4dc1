// SPDX-License-Identifier: Apache-2.0
// What an experiment says about the paper, as tables in Markdown.
#pragma once

#include <string>
#include <vector>

#include "training/experiment/experiment_summary.hpp"

namespace striker::training {

inline constexpr double paper_best_reward = 6.8;  // the greatest value of its RCS curve, read off the figure

// The paper's three claims beside what was found, from the paper's experiment (claims.md).
[[nodiscard]] std::string claims_table(const std::vector<VariantSummary>& summaries);

// Which reading comes closest to the paper's curve (readings.md).
[[nodiscard]] std::string readings_table(const std::vector<VariantSummary>& summaries);

}  // namespace striker::training

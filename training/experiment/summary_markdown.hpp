// SPDX-License-Identifier: Apache-2.0
// An experiment's summary as a table for people, and how its figures are written.
#pragma once

#include <string>
#include <vector>

#include "training/experiment/experiment_summary.hpp"

namespace striker::training {

// "6.92 [6.79, 7.03]".
[[nodiscard]] std::string figure(const Estimate& estimate);

// "688 [616, 708]", and of how many runs if not all of them got there.
[[nodiscard]] std::string figure(const Crossing& crossing, int runs);

// summary.md.
[[nodiscard]] std::string summary_markdown(const std::vector<VariantSummary>& summaries, double ceiling);

}  // namespace striker::training

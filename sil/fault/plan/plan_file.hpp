// SPDX-License-Identifier: Apache-2.0
// Plans as TOML files, in and out. sil/fault/README.md says what stands in one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

// Both throw std::runtime_error with one line that names file, line, field and what it may be.
[[nodiscard]] FaultPlan read_plan(const std::filesystem::path& file);
[[nodiscard]] FaultPlan parse_plan(std::string_view text, const std::string& file);

// Reading it gives the same plan.
[[nodiscard]] std::string plan_text(const FaultPlan& plan);

}  // namespace striker::sil

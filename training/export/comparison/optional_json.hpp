// SPDX-License-Identifier: Apache-2.0
// A figure that may not exist, in a JSON report: null says so.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace striker::training {

[[nodiscard]] inline nlohmann::ordered_json number_or_null(const std::optional<double>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

}  // namespace striker::training

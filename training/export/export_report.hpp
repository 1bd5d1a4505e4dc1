// SPDX-License-Identifier: Apache-2.0
// What an export writes: the header, with a comment that says where it comes from, and its figures as JSON.
#pragma once

#include <string>

#include "training/export/export.hpp"

namespace striker::training {

// The exported header: striker::policy::NAME below a comment that says what it is.
[[nodiscard]] std::string header_of(const Export& exported, const Model& model, const std::string& name);

// The figures of quantisation and comparison. training/README.md explains each.
[[nodiscard]] std::string report_of(const Export& exported, const Model& model);

}  // namespace striker::training

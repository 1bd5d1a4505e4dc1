// SPDX-License-Identifier: Apache-2.0
// The smallest case that still breaks the same invariant: for a reader, and as a test.
#pragma once

#include <functional>

#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

// `fails` plays a case. Drops faults, then halves what is left of their windows from both ends, as long as it fails;
// some dozens of plays. The case has to fail as it is.
[[nodiscard]] FaultCase minimised(FaultCase faults, const std::function<bool(const FaultCase&)>& fails);

}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// The built-in plan of `striker-sil faults`: every kind at least once, each in the middle of a drive.
#pragma once

#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

[[nodiscard]] FaultPlan fault_catalogue();

}  // namespace striker::sil

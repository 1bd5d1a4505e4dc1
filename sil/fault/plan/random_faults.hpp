// SPDX-License-Identifier: Apache-2.0
// Random cases for a campaign: one to three faults of any kind that there is in process, at any time of an episode, for a random robot.
#pragma once

#include <cstdint>

#include "sil/fault/plan/fault_plan.hpp"

namespace striker::sil {

// The campaign's run with this number: a pure function of both. Kinds that stand for nothing that a bus or a robot
// does by itself are drawn like all others; parameters over their whole range.
[[nodiscard]] FaultCase random_case(std::uint64_t seed, std::uint64_t number);

}  // namespace striker::sil

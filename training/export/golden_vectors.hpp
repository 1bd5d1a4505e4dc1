// SPDX-License-Identifier: Apache-2.0
// The golden vectors of an exported policy: raw states, and what the exporter's own integer network answers
// to them. The controller must give the same numbers, at boot and on every target.
#pragma once

#include <cstdint>
#include <vector>

#include "training/export/integer_network.hpp"
#include "training/task/state.hpp"

namespace striker::training {

struct GoldenVector {
  std::vector<std::int32_t> raw;
  IntegerAnswer answer;
};

inline constexpr std::size_t golden_count = 16;

// Four states that saturate every input, and others from `met` (not empty), evenly spaced over it.
[[nodiscard]] std::vector<GoldenVector> golden_vectors(const IntegerNetwork& network,
                                                       const StateInputs& inputs,
                                                       const std::vector<RawState>& met);

}  // namespace striker::training

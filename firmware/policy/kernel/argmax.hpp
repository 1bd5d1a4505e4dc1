// SPDX-License-Identifier: Apache-2.0
// The network's choice: the action whose sum is the greatest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/kernel/branch_free.hpp"

namespace striker::policy::kernel {

// The index of the greatest sum; of equal ones, the lowest index. It takes as many instructions whichever it
// is.
template <std::size_t Actions>
constexpr std::uint8_t index_of_greatest(const std::array<std::int32_t, Actions>& sums) {
  std::int32_t best = sums[0];
  std::int32_t index = 0;
  for (std::size_t k = 1; k < Actions; ++k) {
    const std::int32_t greater = less_mask(best, sums[k]);
    best = choose(greater, sums[k], best);
    index = choose(greater, static_cast<std::int32_t>(k), index);
  }
  return static_cast<std::uint8_t>(index);
}

}  // namespace striker::policy::kernel

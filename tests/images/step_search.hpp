// SPDX-License-Identifier: Apache-2.0
// A search for the longest `step`: a bus that behaves, mostly, and misbehaves in every way that the
// controller's code has a branch for; steps that took long are where it goes on from.
#pragma once

#include <cstdint>

namespace striker::images {

// No tick may bring more frames than this: 1 ms of a 1 Mbit/s bus holds 21 of the shortest (47 bits each).
inline constexpr std::uint32_t most_frames_a_tick = 24;

struct SearchResult {
  std::uint32_t greatest_instructions = 0;  // rounded up to a count of the timer
  std::uint32_t decisions = 0;              // steps that decided
};

[[nodiscard]] SearchResult search_longest_step(std::uint32_t steps, std::uint32_t seed);

}  // namespace striker::images

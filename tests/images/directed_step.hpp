// SPDX-License-Identifier: Apache-2.0
// A step that is built to be long, after the worst path that tools/step-bound names: a tick full of poses that are all
// believed, the last of which completes a picture, a decision on it, and every report due.
#pragma once

#include <cstdint>

namespace striker::images {

// Instructions of the longest of `tries`, rounded up to a count of the timer. Each draws its own speeds, places and
// order of frames.
[[nodiscard]] std::uint32_t longest_directed_step(std::uint32_t tries, std::uint32_t seed);

}  // namespace striker::images

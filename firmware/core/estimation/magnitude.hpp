// SPDX-License-Identifier: Apache-2.0
// The absolute value of an integer, at compile time too, which std::abs is not in C++20.
#pragma once

#include <cstdint>

namespace striker::core {

// Of any value but -2^31.
[[nodiscard]] constexpr std::int32_t magnitude(std::int32_t value) {
  return value < 0 ? -value : value;
}

}  // namespace striker::core

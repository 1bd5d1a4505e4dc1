// SPDX-License-Identifier: Apache-2.0
// How many products a policy's network adds up for an answer: one a weight.
#pragma once

#include <cstddef>

#include "firmware/policy/network.hpp"

namespace striker::policy {

template <const auto& policy>
inline constexpr std::size_t multiply_accumulates = [] {
  using Shape = ShapeOf<policy>;
  std::size_t products = Shape::widths[Shape::hidden_layers] * Shape::actions;
  for (std::size_t n = 0; n < Shape::hidden_layers; ++n) {
    products += Shape::widths[n] * Shape::widths[n + 1];
  }
  return products;
}();

}  // namespace striker::policy

// SPDX-License-Identifier: Apache-2.0
#include "sil/match/referee/free_spot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace striker::sil {
namespace {

constexpr double step_m = 0.01;

std::optional<Vec2> first_free(Vec2 from, Vec2 direction, std::span<const Vec2> others, double clearance_m,
                               double reach_m) {
  for (int steps = 0;; ++steps) {
    const Vec2 spot = {from.x + steps * step_m * direction.x, from.y + steps * step_m * direction.y};
    if (!is_clear_of_walls(spot, reach_m)) {
      return std::nullopt;
    }
    if (is_free(spot, others, clearance_m)) {
      return spot;
    }
  }
}

}  // namespace

bool is_free(Vec2 spot, std::span<const Vec2> others, double clearance_m) {
  return std::ranges::none_of(others, [&](Vec2 other) {
    const double x_m = other.x - spot.x;
    const double y_m = other.y - spot.y;
    return x_m * x_m + y_m * y_m < clearance_m * clearance_m;
  });
}

bool is_clear_of_walls(Vec2 spot, double reach_m) {
  const double corner_m =
      field_half_length_m + field_half_width_m - corner_leg_m - std::numbers::sqrt2 * reach_m;
  return std::abs(spot.x) <= field_half_length_m - reach_m &&
         std::abs(spot.y) <= field_half_width_m - reach_m && std::abs(spot.x) + std::abs(spot.y) <= corner_m;
}

std::optional<Vec2> free_spot(Vec2 wanted, std::span<const Vec2> others, double clearance_m, double reach_m) {
  const std::optional<Vec2> along_x = first_free(wanted, {1.0, 0.0}, others, clearance_m, reach_m);
  return along_x ? along_x : first_free(wanted, {0.0, 1.0}, others, clearance_m, reach_m);
}

}  // namespace striker::sil

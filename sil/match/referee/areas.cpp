// SPDX-License-Identifier: Apache-2.0
#include "sil/match/referee/areas.hpp"

#include <algorithm>

namespace striker::sil {
namespace {

bool in_field(Vec2 spot) {
  return std::abs(spot.x) <= field_half_length_m && std::abs(spot.y) <= field_half_width_m;
}

// The share of the way at which a coordinate passes its limit; 1 if it does not.
double share_until(double before, double now, double limit) {
  return std::abs(now) > limit ? (std::copysign(limit, now) - before) / (now - before) : 1.0;
}

Vec2 clamped(Vec2 spot) {
  return {std::clamp(spot.x, -field_half_length_m, field_half_length_m),
          std::clamp(spot.y, -field_half_width_m, field_half_width_m)};
}

}  // namespace

Vec2 exit_point(Vec2 before, Vec2 now) {
  if (!in_field(before) || !std::isfinite(now.x) || !std::isfinite(now.y)) {
    return clamped(now);
  }
  const double share = std::min(share_until(before.x, now.x, field_half_length_m),
                                share_until(before.y, now.y, field_half_width_m));
  return clamped({before.x + share * (now.x - before.x), before.y + share * (now.y - before.y)});
}

}  // namespace striker::sil

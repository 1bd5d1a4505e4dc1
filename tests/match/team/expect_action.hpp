// SPDX-License-Identifier: Apache-2.0
// Actions that are the same but for rounding; gains to the bit.
#pragma once

#include <gtest/gtest.h>

#include "sil/match/team/rules/action.hpp"

namespace striker::sil {

inline void expect_action(const Action& is, const Action& expected) {
  constexpr double within = 1e-12;
  ASSERT_EQ(is.index(), expected.index());
  if (const auto* way = std::get_if<GoTo>(&expected)) {
    const auto& way_is = std::get<GoTo>(is);
    EXPECT_NEAR(way_is.target_m.x, way->target_m.x, within);
    EXPECT_NEAR(way_is.target_m.y, way->target_m.y, within);
    EXPECT_EQ(way_is.gains, way->gains);
  } else if (const auto* turn = std::get_if<TurnTo>(&expected)) {
    EXPECT_NEAR(std::get<TurnTo>(is).heading_rad, turn->heading_rad, within);
  }
}

}  // namespace striker::sil

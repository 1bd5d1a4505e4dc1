// SPDX-License-Identifier: Apache-2.0
// The RCS state against the paper's equations in double precision (corrected form), and its invariance: the
// same situation at another place on the field is the same state.
#include "firmware/core/estimation/relative_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace striker::core {
namespace {

constexpr double counts_to_rad = std::numbers::pi / 32768.0;

Estimate draw(std::mt19937& random) {
  std::uniform_int_distribution<std::int32_t> place(-4'000'000, 4'000'000);
  std::uniform_int_distribution<std::int32_t> speed(-4000, 4000);
  std::uniform_int_distribution<std::int32_t> angle(-32768, 32767);
  return {{place(random), place(random)},
          static_cast<BinaryAngle>(angle(random)),
          speed(random),
          {place(random), place(random)},
          {speed(random), speed(random)}};
}

TEST(RelativeState, IsThePapersTransformationInItsCorrectedForm) {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Estimate e = draw(random);
    const RelativeState state = relative_state(e);
    const double c = std::cos(e.heading * counts_to_rad);
    const double s = std::sin(e.heading * counts_to_rad);
    const double dx = e.ball_um.x - e.robot_um.x;
    const double dy = e.ball_um.y - e.robot_um.y;
    const double bound_um = std::hypot(dx, dy) / 8192.0 + 16.0;
    ASSERT_NEAR(state.ball_um.x, c * dx + s * dy, bound_um);
    ASSERT_NEAR(state.ball_um.y, -s * dx + c * dy, bound_um);
    const double vx = e.ball_velocity_mm_s.x;
    const double vy = e.ball_velocity_mm_s.y;
    ASSERT_NEAR(state.ball_velocity_mm_s.x, c * vx + s * vy, 2.0);
    ASSERT_NEAR(state.ball_velocity_mm_s.y, -s * vx + c * vy, 2.0);
    ASSERT_EQ(state.robot_speed_mm_s, e.robot_speed_mm_s);
    if (std::hypot(vx, vy) > 200.0) {
      const double angle = std::atan2(vy, vx) / counts_to_rad - e.heading;
      const BinaryAngle error = wrap_angle(static_cast<std::int32_t>(std::lround(angle)) - state.ball_angle);
      ASSERT_LE(std::abs(int{error}), 4);
    }
  }
}

TEST(RelativeState, DoesNotDependOnThePlaceOnTheField) {
  std::mt19937 random(2);
  std::uniform_int_distribution<std::int32_t> shift(-3'000'000, 3'000'000);
  for (int i = 0; i < 5'000; ++i) {
    const Estimate here = draw(random);
    Estimate there = here;
    const Vector by{shift(random), shift(random)};
    there.robot_um = {here.robot_um.x + by.x, here.robot_um.y + by.y};
    there.ball_um = {here.ball_um.x + by.x, here.ball_um.y + by.y};
    const RelativeState a = relative_state(here);
    const RelativeState b = relative_state(there);
    for (int element = 0; element <= 5; ++element) {
      ASSERT_EQ(element_of(a, static_cast<policy::StateElement>(element)),
                element_of(b, static_cast<policy::StateElement>(element)));
    }
  }
}

TEST(RelativeState, ABallAtRestMovesInDirectionZero) {
  Estimate estimate;
  estimate.heading = 12345;
  estimate.ball_velocity_mm_s = {0, rest_speed_mm_s - 1};
  EXPECT_EQ(relative_state(estimate).ball_angle, 0);
  estimate.ball_velocity_mm_s = {0, rest_speed_mm_s};
  EXPECT_NE(relative_state(estimate).ball_angle, 0);
}

}  // namespace
}  // namespace striker::core

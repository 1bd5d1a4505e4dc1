// SPDX-License-Identifier: Apache-2.0
// The CORDIC against double-precision trigonometry: the errors that angle.hpp states.
#include "firmware/core/estimation/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace striker::core {
namespace {

constexpr double counts_to_rad = std::numbers::pi / 32768.0;

TEST(Angle, RotationIsWithinItsStatedError) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> component(-20'000'000, 20'000'000);
  for (std::int32_t counts = -32768; counts <= 32767; counts += 7) {
    const Vector v{component(random), component(random)};
    const double angle = counts * counts_to_rad;
    const Vector turned = rotate(v, static_cast<BinaryAngle>(counts));
    const double x = v.x * std::cos(angle) - v.y * std::sin(angle);
    const double y = v.x * std::sin(angle) + v.y * std::cos(angle);
    const double bound = std::hypot(v.x, v.y) / 8192.0 + 16.0;
    ASSERT_LE(std::hypot(turned.x - x, turned.y - y), bound) << counts;
  }
}

TEST(Angle, DirectionIsWithinFourCounts) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> log_length(4.0, 8.7);
  for (int i = 0; i < 100'000; ++i) {
    const double a = angle(random);
    const double length = std::pow(10.0, log_length(random));
    const Vector v{static_cast<std::int32_t>(length * std::cos(a)),
                   static_cast<std::int32_t>(length * std::sin(a))};
    const double wanted = std::atan2(v.y, v.x) / counts_to_rad;
    const BinaryAngle error = wrap_angle(direction_of(v) - static_cast<std::int32_t>(std::lround(wanted)));
    ASSERT_LE(std::abs(int{error}), 4) << v.x << " " << v.y;
  }
}

TEST(Angle, TheNullVectorPointsForward) {
  EXPECT_EQ(direction_of({0, 0}), 0);
}

TEST(Angle, RotatingThereAndBackKeepsTheVector) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> component(-4'000'000, 4'000'000);
  std::uniform_int_distribution<std::int32_t> counts(-32767, 32767);
  for (int i = 0; i < 10'000; ++i) {
    const Vector v{component(random), component(random)};
    const auto angle = static_cast<BinaryAngle>(counts(random));
    const Vector back = rotate(rotate(v, angle), wrap_angle(-angle));
    ASSERT_NEAR(back.x, v.x, std::hypot(v.x, v.y) / 4096.0 + 40.0);
    ASSERT_NEAR(back.y, v.y, std::hypot(v.x, v.y) / 4096.0 + 40.0);
  }
}

}  // namespace
}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// A robot that always wants to go on, and stops only where the border says so, against its own motion in real numbers.
#include "firmware/core/estimation/field_border.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace striker::core {
namespace {

struct Motion {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double heading_rad = 0.0;
  double speed_mm_s = 0.0;

  void advance(double set_point_mm_s, double gain_mm_s) {
    speed_mm_s += std::clamp(set_point_mm_s - speed_mm_s, -gain_mm_s, gain_mm_s);
    x_mm += 1e-3 * speed_mm_s * std::cos(heading_rad);
    y_mm += 1e-3 * speed_mm_s * std::sin(heading_rad);
  }
  [[nodiscard]] Estimate seen() const {
    const double turns = heading_rad / (2.0 * std::numbers::pi);
    return {.robot_um = {static_cast<std::int32_t>(1e3 * x_mm), static_cast<std::int32_t>(1e3 * y_mm)},
            .heading = wrap_angle(static_cast<std::int32_t>(std::lround(65'536.0 * turns))),
            .robot_speed_mm_s = static_cast<std::int32_t>(speed_mm_s),
            .ball_um = {},
            .ball_velocity_mm_s = {}};
  }
};

RobotProfile on_field(RobotDescription robot, std::int32_t half_length_mm, std::int32_t half_width_mm) {
  robot.field_half_length_mm = half_length_mm;
  robot.field_half_width_mm = half_width_mm;
  return profile_of(robot);
}

double gain_mm_s(const RobotDescription& robot) {
  const double mass_kg = 1e-3 * (robot.body_mass_g + 3 * robot.wheel_mass_g);
  return 2.0 * robot.torque_limit_mNm / (1e-3 * robot.wheel_radius_um * mass_kg);
}

// Forward, stop or backward, each for some decisions. CORDIC errs by less
// than 2 mm of the way, whole mm/s by another.
TEST(FieldBorder, NoDecisionLeadsBeyondIt) {
  std::mt19937 random(11);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const RobotDescription& robot : {forward, defender, goalkeeper}) {
    const RobotProfile profile = on_field(robot, 3'900, 2'325);
    int ended = 0;
    for (int run = 0; run < 20'000; ++run) {
      Motion motion{
          .x_mm = uniform(-3'900, 3'900), .y_mm = uniform(-2'325, 2'325), .heading_rad = uniform(-3.1, 3.1)};
      std::int32_t wanted = 0;
      for (int decision = 0; decision < 40; ++decision) {
        wanted = random() % 8 == 0 ? static_cast<std::int32_t>(random() % 3) - 1 : wanted;
        const std::int32_t set_point_mm_s = wanted * robot.top_rim_speed_mm_s;
        const bool ends = leaves_field(profile, motion.seen(), {set_point_mm_s, set_point_mm_s});
        for (int tick = 0; tick < (ends ? 1'000 : 50); ++tick) {
          motion.advance(ends ? 0.0 : set_point_mm_s, gain_mm_s(robot));
          ASSERT_LE(std::abs(motion.x_mm), 3'900.0 + 3.0) << run << ' ' << decision;
          ASSERT_LE(std::abs(motion.y_mm), 2'325.0 + 3.0) << run << ' ' << decision;
        }
        if (ends) {
          ++ended;
          break;
        }
      }
    }
    EXPECT_GT(ended, 1'000);
  }
}

TEST(FieldBorder, ARobotThatComesBackInMay) {
  const RobotProfile profile = on_field(forward, 1'000, 1'000);
  const Motion outside{.x_mm = 1'500.0, .heading_rad = 0.0};
  EXPECT_FALSE(leaves_field(profile, outside.seen(), {-2'550, -2'550}));
  EXPECT_TRUE(leaves_field(profile, outside.seen(), {2'550, 2'550}));
}

// On both sides alike, also for one that turns in place.
TEST(FieldBorder, OneThatStandsOutsideMayTurn) {
  const RobotProfile profile = on_field(forward, 1'000, 1'000);
  for (const double x_mm : {-1'500.0, 1'500.0}) {
    EXPECT_FALSE(leaves_field(profile, Motion{.x_mm = x_mm}.seen(), {-500, 500}));
    EXPECT_FALSE(leaves_field(profile, Motion{.x_mm = x_mm}.seen(), {}));
  }
}

TEST(FieldBorder, ThereIsNoneUnlessItIsDescribed) {
  const Motion away{.x_mm = 100'000.0, .y_mm = -100'000.0, .heading_rad = 0.5, .speed_mm_s = 2'550.0};
  EXPECT_FALSE(leaves_field(profile_of(forward), away.seen(), {2'550, 2'550}));
  EXPECT_FALSE(leaves_field(on_field(forward, 0, 1'000), Motion{.x_mm = 5'000.0}.seen(), {2'550, 2'550}));
}

// Nothing is given away: in the middle of a field of twice what it takes to stop, all may be done.
TEST(FieldBorder, FarFromItNothingEnds) {
  const RobotProfile profile = on_field(forward, 1'000, 1'000);
  for (double speed_mm_s = -2'550.0; speed_mm_s <= 2'550.0; speed_mm_s += 50.0) {
    for (const std::int32_t wanted_mm_s : {-2'550, 0, 2'550}) {
      EXPECT_FALSE(
          leaves_field(profile, Motion{.speed_mm_s = speed_mm_s}.seen(), {wanted_mm_s, wanted_mm_s}));
    }
  }
}

}  // namespace
}  // namespace striker::core

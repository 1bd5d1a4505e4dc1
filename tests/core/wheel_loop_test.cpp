// SPDX-License-Identifier: Apache-2.0
// The wheel loop on the plant it was tuned for: limits, no wind-up, no steady error.
#include "firmware/core/wheel_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <random>

namespace striker::core {
namespace {

constexpr RobotProfile robot = profile_of(forward);
constexpr double acceleration_mm_s2_per_mNm = 27.8;

std::int32_t step(WheelLoop& loop, const RobotProfile& told, std::int32_t set_point_mm_s,
                  std::int32_t measured_mm_s, PendingTorque& pending) {
  loop.see(told, measured_mm_s);
  return loop.step(told, set_point_mm_s, measured_mm_s, loop.limit_mNm(told), pending);
}

// Runs the loop for a while on a forward robot with a 1 ms current-loop lag, and commands that are late.
struct Rig {
  RobotProfile told = robot;
  double mass_share = 1.0;
  std::size_t delay_ticks = 0;
  WheelLoop loop = {};
  PendingTorque pending = {};
  std::deque<std::int32_t> on_its_way = {};
  double speed_mm_s = 0.0;
  double torque_mNm = 0.0;
  double greatest_mm_s = 0.0;

  void run(std::int32_t set_point_mm_s, int ticks, double drag_mNm = 0.0) {
    for (int tick = 0; tick < ticks; ++tick) {
      const auto measured_mm_s = static_cast<std::int32_t>(std::lround(speed_mm_s));
      on_its_way.push_back(step(loop, told, set_point_mm_s, measured_mm_s, pending));
      std::int32_t given_mNm = 0;
      if (on_its_way.size() > delay_ticks) {
        given_mNm = on_its_way.front();
        on_its_way.pop_front();
      }
      torque_mNm += 0.632 * (given_mNm - torque_mNm);
      speed_mm_s += acceleration_mm_s2_per_mNm / mass_share * (torque_mNm - drag_mNm) * 0.001;
      greatest_mm_s = std::max(greatest_mm_s, speed_mm_s);
    }
  }
};

TEST(WheelLoop, ReachesTheSetPointWithoutOvershootBeyondTwoPercent) {
  Rig rig;
  rig.run(2550, 600);
  EXPECT_NEAR(rig.speed_mm_s, 2550.0, 5.0);
  EXPECT_LE(rig.greatest_mm_s, 2550.0 * 1.02);
}

TEST(WheelLoop, NeverExceedsTheTorqueLimit) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> speed(-8000, 8000);
  for (const std::int32_t delay_ticks : {0, 20}) {
    RobotProfile any = robot;
    any.command_delay_ticks = delay_ticks;
    WheelLoop loop;
    PendingTorque pending;
    for (int i = 0; i < 200'000; ++i) {
      ASSERT_LE(std::abs(step(loop, any, speed(random), speed(random), pending)), any.torque_limit_mNm);
    }
  }
}

// At the ends of everything, for robots up to the greatest that is accepted (UBSan watches), and one beyond.
TEST(WheelLoop, WhatIsAcceptedStaysWithin32Bits) {
  for (const RobotDescription& description : {forward, defender, goalkeeper,
                                              RobotDescription{.body_mass_g = 20'000,
                                              .wheel_mass_g = 500,
                                              .wheel_radius_um = 100'000,
                                              .axle_length_um = 140'000,
                                              .torque_limit_mNm = 2'000,
                                              .top_rim_speed_mm_s = 2'500,
                                              .command_delay_ms = 50}}) {
    const RobotProfile any = profile_of(description);
    ASSERT_TRUE(loops_fit(any));
    WheelLoop loop;
    PendingTorque pending;
    for (const std::int32_t set_point : {any.top_rim_speed_mm_s, -any.top_rim_speed_mm_s}) {
      for (const std::int32_t measured : {-8000, 0, 8000}) {
        for (int tick = 0; tick < 2000; ++tick) {
          const std::int32_t torque = step(loop, any, set_point, measured, pending);
          ASSERT_LE(std::abs(torque), any.torque_limit_mNm);
        }
      }
    }
  }
  EXPECT_FALSE(loops_fit(profile_of({.body_mass_g = 100'000,
                                     .wheel_mass_g = 500,
                                     .wheel_radius_um = 165'000,
                                     .axle_length_um = 140'000,
                                     .torque_limit_mNm = 2'000,
                                     .top_rim_speed_mm_s = 2'500})));
}

TEST(WheelLoop, ARobotWhoseNumbersDoNotFitIsRefused) {
  const auto refused = [](auto alter) {
    RobotProfile altered = profile_of(forward);
    alter(altered);
    return !loops_fit(altered);
  };
  EXPECT_FALSE(refused([](RobotProfile&) {}));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.torque_limit_mNm = 0; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.top_rim_speed_mm_s = 8001; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.camera_latency_ticks = 51; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.camera_latency_ticks = -1; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.picture_period_us = 9'999; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.picture_period_us = 100'001; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.command_delay_ticks = 51; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.command_delay_ticks = -1; }));
  EXPECT_TRUE(refused([](RobotProfile& it) { it.slip_gain_q12 = -1; }));
}

TEST(WheelLoop, RemovesASteadyLoad) {
  for (const std::int32_t delay_ms : {0, 20, 50}) {
    RobotDescription described = forward;
    described.command_delay_ms = delay_ms;
    for (const std::int32_t set_point_mm_s : {1000, 0}) {
      Rig rig{.told = profile_of(described), .delay_ticks = static_cast<std::size_t>(delay_ms)};
      rig.run(set_point_mm_s, 3000, 60.0);
      EXPECT_NEAR(rig.speed_mm_s, set_point_mm_s, 3.0) << delay_ms;
    }
  }
}

// A delay that was told, to a quarter of it, and a robot that is not quite as heavy as told.
TEST(WheelLoop, LateCommandsThatAreToldOfDoNotMakeItSwing) {
  for (const std::int32_t told_ms : {4, 20, 50}) {
    for (const double delay_share : {0.75, 1.0, 1.25}) {
      for (const double mass_share : {0.9, 1.0, 1.1}) {
        RobotDescription late = forward;
        late.command_delay_ms = told_ms;
        Rig rig{.told = profile_of(late),
                .mass_share = mass_share,
                .delay_ticks = static_cast<std::size_t>(std::lround(delay_share * told_ms))};
        rig.run(2000, 1000);
        EXPECT_LE(rig.greatest_mm_s, 2000.0 * 1.15) << told_ms << ' ' << delay_share << ' ' << mass_share;
        EXPECT_NEAR(rig.speed_mm_s, 2000.0, 40.0) << told_ms << ' ' << delay_share << ' ' << mass_share;
      }
    }
  }
}

TEST(WheelLoop, LateCommandsThatNobodyTellsOfDo) {
  Rig rig{.delay_ticks = 50};
  rig.run(2000, 1000);
  EXPECT_GT(rig.greatest_mm_s, 2000.0 * 1.15);
}

// Blocked at full torque for ten seconds, then told to go back: the torque must turn round at once.
TEST(WheelLoop, DoesNotWindUp) {
  WheelLoop loop;
  PendingTorque pending;
  for (int tick = 0; tick < 10'000; ++tick) {
    EXPECT_EQ(step(loop, robot, 2550, 0, pending), robot.torque_limit_mNm);
  }
  EXPECT_LE(step(loop, robot, -500, 0, pending), -robot.torque_limit_mNm + 1);
}

// A motor that does not do what it is told, as a speed servo: its robot moves as measured, however long that lasts.
TEST(WheelLoops, WhereCommandsAreLateTheRobotMovesAsMeasured) {
  RobotProfile late = robot;
  for (const std::int32_t delay_ticks : {1, 20, 50}) {
    late.command_delay_ticks = delay_ticks;
    WheelLoops loops;
    PendingTorques pending;
    for (std::int32_t tick = 0; tick < 300; ++tick) {
      const WheelSpeeds measured = {std::min(20 * tick, 2550), std::max(-20 * tick, -2550)};
      EXPECT_EQ(loops.see(late, measured), measured);
      (void)loops.step(late, {2550, -2550}, measured, pending);
    }
  }
}

}  // namespace
}  // namespace striker::core

// SPDX-License-Identifier: Apache-2.0
// The slip limiter on a wheel whose tyre holds by Coulomb's law: it costs a wheel that grips nothing, and one that
// would spin neither runs away nor gives up what grip there is.
#include "firmware/core/slip_limiter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace striker::core {
namespace {

constexpr RobotProfile robot = profile_of(forward);

// Half a robot on one wheel, at its full torque: SI units, steps of 0.1 ms.
struct Wheel {
  double robot_kg = 0.85;  // half of a forward's body and wheels
  double torque_share = 1.0;
  double friction = 3.0;
  double rim_m_s = 0.0;
  double robot_m_s = 0.0;

  static constexpr double radius_m = 0.04;
  static constexpr double spin_kg = 0.05;  // what the wheel's spin weighs at its rim

  void move(double torque_Nm) {
    for (int i = 0; i < 10; ++i) {
      constexpr double step_s = 1e-4;
      const double grip_N = friction * 9.81 * robot_kg;
      const double drive_N = torque_share * torque_Nm / radius_m;
      // What would keep rim and robot together, as far as the tyre holds.
      const double together_N =
          (drive_N * robot_kg - (robot_m_s - rim_m_s) / step_s * robot_kg * spin_kg) / (robot_kg + spin_kg);
      const double held_N = std::clamp(together_N, -grip_N, grip_N);
      robot_m_s += step_s * held_N / robot_kg;
      rim_m_s += step_s * (drive_N - held_N) / spin_kg;
    }
  }

  // By a 14-bit encoder over 1 ms.
  [[nodiscard]] std::int32_t measured_mm_s() const {
    constexpr double count_mm_s = 2.0 * 3.14159265 * radius_m / 16384.0 * 1e6;
    return static_cast<std::int32_t>(std::lround(std::floor(rim_m_s * 1e3 / count_mm_s) * count_mm_s));
  }
};

struct Ride {
  double greatest_slip_m_s = 0.0;
  double greatest_error_m_s = 0.0;  // of the rolling speed
  double gained_m_s = 0.0;
  int cuts = 0;
  int last_cut = -1;
};

// As much torque as it may have, forward or back, with a current loop of 1 ms.
Ride ride(Wheel wheel, int direction, int ticks = 200) {
  SlipLimiter slip(wheel.measured_mm_s());
  Ride result;
  double torque_Nm = 0.0;
  std::int32_t before_mNm = robot.torque_limit_mNm;
  for (int tick = 0; tick < ticks; ++tick) {
    slip.see(robot, wheel.measured_mm_s());
    const std::int32_t limit_mNm = slip.limit_mNm(robot);
    if (limit_mNm < before_mNm / 2) {
      ++result.cuts;
      result.last_cut = tick;
    }
    before_mNm = limit_mNm;
    slip.acts(direction * limit_mNm);
    result.greatest_error_m_s =
        std::max(result.greatest_error_m_s, std::abs(slip.rolling_mm_s() * 1e-3 - wheel.robot_m_s));
    torque_Nm += 0.632 * (direction * limit_mNm * 1e-3 - torque_Nm);
    wheel.move(torque_Nm);
    result.greatest_slip_m_s = std::max(result.greatest_slip_m_s, std::abs(wheel.rim_m_s - wheel.robot_m_s));
  }
  result.gained_m_s = direction * wheel.robot_m_s;
  return result;
}

constexpr double full_m_s2 = 0.4 / Wheel::radius_m / (0.85 + Wheel::spin_kg);

TEST(SlipLimiter, AWheelThatGripsHasAllItsTorque) {
  for (const double mass : {0.95, 1.0, 1.3}) {
    for (const double torque : {0.7, 1.0}) {
      for (const int direction : {-1, 1}) {
        EXPECT_EQ(ride({.robot_kg = 0.85 * mass, .torque_share = torque, .friction = 10.0}, direction).cuts,
                  0)
            << mass << ' ' << torque;
      }
    }
  }
}

// It looks as if it spun, at first.
TEST(SlipLimiter, ALighterOrStrongerRobotIsLearnedWithinATenthOfASecond) {
  for (const double share : {1.15, 1.3, 1.5}) {
    for (const int direction : {-1, 1}) {
      const Ride seen = ride({.torque_share = share, .friction = 20.0}, direction);
      EXPECT_LT(seen.last_cut, 100) << share;
      EXPECT_GT(seen.gained_m_s, 0.88 * 0.2 * share * full_m_s2) << share;
    }
  }
}

TEST(SlipLimiter, ARobotThatRollsAtFirstIsTakenForNoSpinningOne) {
  for (const double speed_m_s : {-2.5, 2.5}) {
    for (const int direction : {-1, 1}) {
      EXPECT_EQ(ride({.friction = 10.0, .rim_m_s = speed_m_s, .robot_m_s = speed_m_s}, direction, 50).cuts,
                0);
    }
  }
}

TEST(SlipLimiter, AWheelThatWouldSpinKeepsNearTheRobotAndMostOfItsGrip) {
  for (const double friction : {0.3, 0.6, 0.9}) {
    for (const int direction : {-1, 1}) {
      const Ride seen = ride({.friction = friction}, direction);
      EXPECT_LT(seen.greatest_slip_m_s, 0.5) << friction << ": without it 20 m/s or more";
      EXPECT_GT(seen.gained_m_s, 0.75 * 0.2 * 9.81 * friction)
          << friction << ": of what the floor would give";
      EXPECT_LE(seen.cuts, 20) << friction;
    }
  }
}

TEST(SlipLimiter, KnowsHowFastTheRobotRollsWhileItsWheelsSpin) {
  for (const double mass : {0.7, 1.0, 1.3}) {
    for (const double friction : {0.4, 0.6, 0.9}) {
      for (const int direction : {-1, 1}) {
        const Ride seen = ride({.robot_kg = 0.85 * mass, .friction = friction}, direction);
        EXPECT_LT(seen.greatest_error_m_s, 0.15) << mass << ' ' << friction;
      }
    }
  }
}

TEST(SlipLimiter, ARimThatNoLongerFallsTellsTheSpeed) {
  SlipLimiter slip;
  slip.acts(robot.torque_limit_mNm);
  for (const std::int32_t rim_mm_s : {500, 560, 400, 250, 100, 100}) {
    slip.see(robot, rim_mm_s);
    slip.acts(slip.limit_mNm(robot));
  }
  EXPECT_EQ(slip.rolling_mm_s(), 100);
}

TEST(SlipLimiter, AWheelInTheAirLosesMostOfItsTorque) {
  const Ride seen = ride({.friction = 0.0}, 1, 60);
  EXPECT_LT(seen.greatest_slip_m_s, 0.25 * 0.06 * 0.4 / Wheel::radius_m / Wheel::spin_kg);
}

TEST(SlipLimiter, WhereCommandsAreLateTheNextCutWaitsForTheLast) {
  RobotProfile late = robot;
  late.command_delay_ticks = 20;
  SlipLimiter slip;
  std::vector<std::int32_t> limits_mNm;
  for (int tick = 0; tick < 60; ++tick) {
    slip.see(late, 100 * tick);  // free in the air, with torque that was on its way
    limits_mNm.push_back(slip.limit_mNm(late));
    slip.acts(late.torque_limit_mNm);
  }
  int cuts = 0;
  int last_cut = -20;
  for (int tick = 1; tick < 60; ++tick) {
    const auto i = static_cast<std::size_t>(tick);
    if (limits_mNm[i] < limits_mNm[i - 1]) {
      EXPECT_GE(tick - last_cut, 20);
      EXPECT_NEAR(limits_mNm[i - 1] - limits_mNm[i], 75, 1);  // 48 / 256 of 400
      last_cut = tick;
      ++cuts;
    }
  }
  EXPECT_EQ(cuts, 3);
}

TEST(SlipLimiter, GripThatComesBackGetsAllTorqueWithinASecond) {
  SlipLimiter slip;
  for (int tick = 0; tick < 50; ++tick) {
    slip.see(robot, 3000 + 100 * (tick % 5));
    slip.acts(slip.limit_mNm(robot));
  }
  EXPECT_LT(slip.limit_mNm(robot), robot.torque_limit_mNm);
  for (int tick = 0; tick < 1000; ++tick) {
    slip.acts(0);
    slip.see(robot, 1000);
  }
  EXPECT_EQ(slip.limit_mNm(robot), robot.torque_limit_mNm);
}

}  // namespace
}  // namespace striker::core

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
  double gained_m_s = 0.0;
  std::int32_t least_limit_mNm = 1'000'000;
};

// As much torque as it may have, forward or back, for 200 ms.
Ride ride(Wheel wheel, int direction) {
  SlipLimiter slip;
  Ride result;
  for (int tick = 0; tick < 200; ++tick) {
    const std::int32_t limit_mNm = slip.limit(robot, wheel.measured_mm_s());
    slip.acts(direction * limit_mNm);
    wheel.move(direction * limit_mNm * 1e-3);
    result.greatest_slip_m_s = std::max(result.greatest_slip_m_s, std::abs(wheel.rim_m_s - wheel.robot_m_s));
    result.least_limit_mNm = std::min(result.least_limit_mNm, limit_mNm);
  }
  result.gained_m_s = direction * wheel.robot_m_s;
  return result;
}

TEST(SlipLimiter, AWheelThatGripsHasAllItsTorque) {
  for (const double mass : {0.7, 1.0, 1.3}) {
    for (const double torque : {0.7, 1.0, 1.1}) {
      for (const int direction : {-1, 1}) {
        const Ride seen =
            ride({.robot_kg = 0.85 * mass, .torque_share = torque, .friction = 10.0}, direction);
        EXPECT_EQ(seen.least_limit_mNm, robot.torque_limit_mNm) << mass << ' ' << torque;
      }
    }
  }
}

TEST(SlipLimiter, AWheelThatWouldSpinKeepsNearTheRobotAndMostOfItsGrip) {
  for (const double friction : {0.3, 0.6, 0.9}) {
    for (const int direction : {-1, 1}) {
      const Ride seen = ride({.friction = friction}, direction);
      EXPECT_LT(seen.greatest_slip_m_s, 1.5) << friction << ": without it 20 m/s or more";
      EXPECT_GT(seen.gained_m_s, 0.7 * 0.2 * 9.81 * friction) << friction << ": of what the floor would give";
    }
  }
}

TEST(SlipLimiter, WhereCommandsAreLateTheNextCutWaitsForTheLast) {
  RobotProfile late = robot;
  late.command_delay_ticks = 20;
  SlipLimiter slip;
  std::vector<std::int32_t> limits_mNm;
  for (int tick = 0; tick < 60; ++tick) {
    limits_mNm.push_back(slip.limit(late, 100 * tick));  // free in the air, with torque that was on its way
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

TEST(SlipLimiter, GripThatComesBackGetsAllTorqueWithinAQuarterOfASecond) {
  SlipLimiter slip;
  (void)slip.limit(robot, 0);
  slip.acts(robot.torque_limit_mNm);
  for (int tick = 0; tick < 50; ++tick) {
    slip.acts(slip.limit(robot, 3000 + 100 * tick));
  }
  for (int tick = 0; tick < 250; ++tick) {
    slip.acts(0);
    (void)slip.limit(robot, 1000);
  }
  EXPECT_EQ(slip.limit(robot, 1000), robot.torque_limit_mNm);
}

}  // namespace
}  // namespace striker::core

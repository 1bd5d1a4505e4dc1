// SPDX-License-Identifier: Apache-2.0
// What follows from a description, against figures worked out by hand or found by stepping the loop itself.
#include "sil/robot/description/robot_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace striker::sil {
namespace {

TEST(RobotReport, AForwardsFiguresAreThoseWorkedOutByHand) {
  const DescribedFigures forward = figures_of(core::forward);
  EXPECT_DOUBLE_EQ(forward.moved_mass_kg, 1.8);         // 1.5 + 2 x 0.1, and half of that spinning
  EXPECT_NEAR(forward.acceleration_m_s2, 11.11, 0.01);  // 2 x 0.4 / (0.04 x 1.8)
  EXPECT_NEAR(forward.grip_m_s2, 29.43, 0.01);          // 3 x 9.81
  EXPECT_NEAR(forward.time_to_top_s, 0.2295, 0.0001);   // 2.55 / 11.11
  EXPECT_NEAR(forward.way_to_top_m, 0.2926, 0.0001);    // 2.55^2 / (2 x 11.11)
  EXPECT_NEAR(forward.turn_rate_rad_s, 36.4, 0.1);      // 2 x 2.55 / 0.14
  EXPECT_NEAR(forward.kp_mNm_s_mm, 3.6, 0.01);          // 100 x 0.04 x 1.8 / 2
  EXPECT_NEAR(forward.crossover_rad_s, 100.0, 1.0);
  EXPECT_NEAR(forward.phase_margin_deg, 67.0, 0.5);  // 90 - atan(0.1) - 100 x 0.003 rad
  EXPECT_DOUBLE_EQ(forward.motion_ms, 50.0);
  EXPECT_DOUBLE_EQ(forward.velocity_step_mm_s, 5.0);  // 0.25 mm in 50 ms
  EXPECT_NEAR(forward.slip_m_s2, 12.2, 0.1);          // a tenth more than the acceleration
  EXPECT_NEAR(forward.overspeed_m_s, 2.93, 0.01);     // 15 % above the top
}

// The loop in steps of 0.01 ms, with its delay: does it settle?
bool settles(const DescribedFigures& loop, const core::RobotDescription& robot, double gain) {
  constexpr double step_s = 1e-5;
  const double gain_1_kg = gain * 2.0 / (robot.wheel_radius_um / 1e6 * loop.moved_mass_kg);
  std::deque<double> on_its_way(static_cast<std::size_t>(std::lround(loop.delay_ms * 1e-3 / step_s)), 0.0);
  double speed = 0.0;
  double integral = 0.0;
  double early = 0.0;
  double late = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    const double error = 1.0 - speed;
    integral += loop.ki_mNm_mm * error * step_s;
    on_its_way.push_back(loop.kp_mNm_s_mm * error + integral);
    speed += gain_1_kg * on_its_way.front() * step_s;
    on_its_way.pop_front();
    double& swing = i < 100'000 ? early : late;
    swing = std::max(swing, std::abs(error) * (i % 100'000 > 50'000 ? 1.0 : 0.0));
  }
  return late < early;
}

TEST(RobotReport, TheGainMarginIsWhereTheLoopBeginsToSwing) {
  core::RobotDescription late = core::forward;
  late.command_delay_ms = 20;
  for (const core::RobotDescription& robot : {core::forward, core::goalkeeper, late}) {
    const DescribedFigures figures = figures_of(robot);
    EXPECT_TRUE(settles(figures, robot, 0.97 * figures.gain_margin)) << figures.gain_margin;
    EXPECT_FALSE(settles(figures, robot, 1.03 * figures.gain_margin)) << figures.gain_margin;
  }
}

TEST(RobotReport, AFastCamerasMotionIsMeasuredOverAboutADecision) {
  core::RobotDescription robot = core::forward;
  for (const auto& [rate_Hz, motion_ms] :
       {std::pair{10, 100.0}, {20, 50.0}, {30, 2e3 / 30.0}, {50, 60.0}, {60, 50.0}, {100, 50.0}}) {
    robot.camera_rate_Hz = rate_Hz;
    EXPECT_DOUBLE_EQ(figures_of(robot).motion_ms, motion_ms) << rate_Hz << " Hz";
  }
}

TEST(RobotReport, SaysWhereKicksEnd) {
  core::RobotDescription robot = core::forward;
  EXPECT_NE(robot_report(figures_of(robot)).find("x nowhere, y nowhere"), std::string::npos);
  robot.field_half_length_mm = 3'900;
  EXPECT_NE(robot_report(figures_of(robot)).find("x +-3.900 m, y nowhere"), std::string::npos);
}

TEST(RobotReport, MoreTorqueThanTheTyresHoldIsTold) {
  core::RobotDescription slippery = core::forward;
  EXPECT_EQ(robot_report(figures_of(slippery)).find("more than the tyres hold"), std::string::npos);
  slippery.tyre_friction_percent = 100;
  EXPECT_NE(robot_report(figures_of(slippery)).find("more than the tyres hold"), std::string::npos);
}

}  // namespace
}  // namespace striker::sil

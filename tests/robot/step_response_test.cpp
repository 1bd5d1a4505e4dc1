// SPDX-License-Identifier: Apache-2.0
// The wheel loops in the full world: every role, as described and not, follows its steps without spinning wheels and without
// going beyond.
#include "sil/robot/step_response.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace striker::sil {
namespace {

StepFigures figures_with(const core::RobotDescription& robot, const std::string& variation,
                         const StepOptions& options = {}) {
  return figures_of(step_response(robot, variation_of(variation), options), options);
}

TEST(StepResponse, EveryRoleFollowsWhateverItIsInTruth) {
  for (const core::RobotDescription& robot : {core::forward, core::defender, core::goalkeeper}) {
    for (const std::string variation :
         {"", "mass=0.7", "mass=1.3", "torque=0.7", "torque=1.3", "friction=0.5"}) {
      for (const bool turns : {false, true}) {
        const StepFigures seen = figures_with(robot, variation, {.turns = turns});
        EXPECT_GT(seen.nine_tenths_ms, 0) << robot.top_rim_speed_mm_s << ' ' << variation << ' ' << turns;
        EXPECT_LT(seen.overshoot_percent, 5.0)
            << robot.top_rim_speed_mm_s << ' ' << variation << ' ' << turns;
        EXPECT_LT(seen.slipping_ms, 25) << robot.top_rim_speed_mm_s << ' ' << variation << ' ' << turns;
      }
    }
  }
}

// 0.8 of 2.55 m/s at 11.1 m/s^2 takes 184 ms, and the last of it is taken gently.
TEST(StepResponse, AForwardTakesLittleLongerThanItsTorqueAllows) {
  const StepFigures seen = figures_with(core::forward, "");
  EXPECT_NEAR(seen.nine_tenths_ms - seen.tenth_ms, 184, 10);
}

// The rim alone does not tell that a wheel spins: the floor does. Friction 1 holds 5.9 m/s^2, as the skids carry a part of
// the weight (sil/README.md); the torque limit would give 11.1.
TEST(StepResponse, OnASlipperyFloorItGainsWhatTheFloorHolds) {
  const auto rows = step_response(core::forward, variation_of("friction=0.333"), {});
  const double gained_m_s2 = (rows[700].moved_mm_s - rows[550].moved_mm_s) / 150.0;
  EXPECT_GT(gained_m_s2, 0.95 * 5.9);
}

TEST(StepResponse, IsDeterministicAndStaysWithinTheTopSpeed) {
  const auto csv = [] {
    return step_csv(step_response(core::forward, variation_of("mass=0.9"), {.step_ms = 100}));
  };
  EXPECT_EQ(csv(), csv());
  EXPECT_THROW((void)step_response(core::goalkeeper, {}, {.set_point_m_s = 2.5}), std::runtime_error);
  for (const std::string meaningless :
       {"vision_noise_mm=5", "camera_rate_Hz=20", "vision_latency_ms=0", "ball_damping=0.9"}) {
    EXPECT_THROW((void)step_response(core::forward, variation_of(meaningless), {}), std::runtime_error);
  }
}

// Of a robot that stands on ice, whose rims are at their set-point at once.
TEST(StepResponse, ARimThatSpinsIsNoStepFollowed) {
  const StepFigures seen =
      figures_with(core::defender, "mass=0.5,torque=1.5,friction=0.1", {.step_ms = 100, .turns = true});
  EXPECT_EQ(seen.nine_tenths_ms, -1);
  EXPECT_GT(seen.greatest_slip_mm_s, 1'000.0);
}

TEST(StepResponse, ASmallStepDoesNotSlip) {
  for (const double set_point_m_s : {0.011, 0.05, 0.1, 0.14}) {
    EXPECT_EQ(figures_with(core::forward, "", {.set_point_m_s = set_point_m_s}).slipping_ms, 0)
        << set_point_m_s;
  }
}

}  // namespace
}  // namespace striker::sil

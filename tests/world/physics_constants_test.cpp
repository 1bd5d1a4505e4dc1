// SPDX-License-Identifier: Apache-2.0
// The constants that C++ cannot compute are those that they are said to be.
#include "sil/world/physics_constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sil/world/ode/ode_world.hpp"
#include "sil/world/planar_robot.hpp"

namespace striker::sil {
namespace {

TEST(PhysicsConstants, OneDampingInThreeForms) {
  EXPECT_DOUBLE_EQ(damping_per_s, -std::log(kept_after_1_s));  // of 0.8 itself, not of the nearest double
  EXPECT_EQ(kept_in_10_ms, kept_in_step(0.010));
  EXPECT_EQ(kept_in_step(1.0), kept_after_1_s);
}

// What planar_robot.hpp says of a forward.
TEST(PhysicsConstants, ThePlanarRobotIsAForward) {
  EXPECT_EQ(planar_forward.mass_kg, 1.8);
  EXPECT_EQ(planar_forward.wheel_inertia_kgm2, 2.0 * 0.15 * 0.07 * 0.07);
  EXPECT_EQ(planar_forward.own_inertia_kgm2, 1.5 * (0.15 * 0.15 + 0.15 * 0.15) / 12.0 +
                                                 2.0 * 0.1 * (3.0 * 0.04 * 0.04 + 0.004 * 0.004) / 12.0);
  EXPECT_EQ(planar_forward.grip_N, 3.0 * 9.81 * 1.7 / 2.0);
}

}  // namespace
}  // namespace striker::sil

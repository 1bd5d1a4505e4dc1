// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/materials.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

TEST(Materials, TheSameSpringAndDamperAtAnotherStep) {
  const Softness soft = soften({.erp = 0.15, .cfm = 1e-5}, 0.001);
  EXPECT_NEAR(soft.erp, 0.0173, 5e-5);
  EXPECT_NEAR(soft.cfm, 1.156e-5, 5e-9);
  for (const double step_s : {0.0005, 0.002, 0.005, 0.020}) {
    const Softness other = soften({.erp = 0.15, .cfm = 1e-5}, step_s);
    EXPECT_NEAR(other.erp / (step_s * other.cfm), 1.5e6, 1.0) << step_s;
    EXPECT_NEAR((1.0 - other.erp) / other.cfm, 8.5e4, 1.0) << step_s;
  }
}

TEST(Materials, TheReferenceStepKeepsTheTable) {
  EXPECT_EQ(soften({.erp = 0.15, .cfm = 1e-5}, reference_step_s).erp, 0.15);
  EXPECT_EQ(soften({.erp = 0.15, .cfm = 1e-5}, reference_step_s).cfm, 1e-5);
}

TEST(Materials, RigidAndSpringlessContactsStayAsTheyAre) {
  for (const double step_s : {0.001, 0.010}) {
    EXPECT_EQ(soften({.erp = 1.0, .cfm = 0.0}, step_s).erp, 1.0);
    EXPECT_EQ(soften({.erp = 1.0, .cfm = 0.0}, step_s).cfm, 0.0);
    EXPECT_EQ(soften({.erp = 0.0, .cfm = 1e-7}, step_s).erp, 0.0);
    EXPECT_DOUBLE_EQ(soften({.erp = 0.0, .cfm = 1e-7}, step_s).cfm, 1e-7);
  }
}

TEST(Materials, OnlyAPairThatBouncesAsksForIt) {
  EXPECT_EQ(surface(Pair::floor_wheel, 0.010).mode & dContactBounce, 0);
  EXPECT_NE(surface(Pair::body_ball, 0.010).mode & dContactBounce, 0);
  EXPECT_EQ(surface(Pair::body_ball, 0.010).bounce, 0.8);
  EXPECT_EQ(surface(Pair::goalkeeper_ball, 0.010).bounce, 0.5);
  EXPECT_EQ(surface(Pair::floor_wheel, 0.010).mu, 3.0);
  EXPECT_EQ(surface(Pair::floor_body, 0.010).mu, 0.0);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/field.hpp"

#include <gtest/gtest.h>

#include "sil/world/field_specs.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

TEST(Field, TheRobotsCeilingHangsAtItsHeight) {
  dInitODE2(0);
  const Field field = make_field(true);
  dGeomID ceiling = field.robot_ceiling.get();
  EXPECT_NEAR(dGeomPlanePointDepth(ceiling, 1.0, 2.0, robot_ceiling_m - 0.1), -0.1, 1e-12);
  EXPECT_NEAR(dGeomPlanePointDepth(ceiling, 1.0, 2.0, robot_ceiling_m + 0.1), 0.1, 1e-12);
}

TEST(Field, AnOpenFloorIsAllThereIs) {
  dInitODE2(0);
  const Field field = make_field(false);
  EXPECT_TRUE(field.walls.empty());
  EXPECT_EQ(field.robot_ceiling, nullptr);
}

TEST(Field, TheCheapTestNeverMissesAWall) {
  dInitODE2(0);
  const Field field = make_field(true);
  const GeomHandle ball(dCreateSphere(nullptr, ball_radius_m));
  int touching = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(1, i, 0);
    const double x_m = random.uniform(-4.5, 4.5);
    const double y_m = random.uniform(-2.5, 2.5);
    dGeomSetPosition(ball.get(), x_m, y_m, ball_radius_m);
    bool touches = false;
    for (const GeomHandle& wall : field.walls) {
      dContactGeom contact;
      touches = touches || dCollide(ball.get(), wall.get(), 1, &contact, sizeof(contact)) > 0;
    }
    touching += touches ? 1 : 0;
    ASSERT_TRUE(!touches || near_wall(x_m, y_m, ball_radius_m)) << x_m << ", " << y_m;
  }
  EXPECT_GT(touching, 1'000);
}

}  // namespace
}  // namespace striker::sil

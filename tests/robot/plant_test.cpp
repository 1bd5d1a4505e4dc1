// SPDX-License-Identifier: Apache-2.0
#include "sil/robot/plant.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

TEST(Plant, EveryKindHasANameOfItsOwn) {
  for (const PlantKind kind : plant_kinds) {
    EXPECT_EQ(plant_kind_of(name_of(kind)), kind);
  }
  EXPECT_FALSE(plant_kind_of("steam"));
}

// The speed of a forward's wheels that are told to do their utmost for 20 ms, by motors of this role.
double speed_m_s(Role role, bool cut = false) {
  World world({.robots = {robot_spec(Role::forward)}, .walls = false, .step_s = tick_s});
  const auto plant = make_plant(PlantKind::drive, 0, robot_spec(role));
  for (int i = 0; i < 20; ++i) {
    plant->actuate(world, {WheelOrder{.torque_Nm = 10.0}, WheelOrder{.torque_Nm = 10.0}}, cut);
    world.step();
    plant->sense(world);
  }
  return plant->measured().left_m_s;
}

TEST(Plant, TheTorqueCeilingIsTheRoles) {
  EXPECT_NEAR(speed_m_s(Role::forward), 11.1 * 0.019, 0.03) << "0.4 Nm a wheel push 1.8 kg";
  EXPECT_GT(speed_m_s(Role::goalkeeper), 2.0 * speed_m_s(Role::forward)) << "and 0.8 Nm make the tyres slip";
}

TEST(Plant, CutDrivesDoNothing) {
  EXPECT_EQ(speed_m_s(Role::forward, true), 0.0);
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// Ten robots drive about at random, after the ball and away from it: what a match needs of its world. Longer with
// STRIKER_WORLD_SECONDS.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "sil/world/field_specs.hpp"
#include "tests/world/match/drivers.hpp"
#include "tests/world/match/field_depth.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

double simulated_s(double unless_told_s) {
  const char* told = std::getenv("STRIKER_WORLD_SECONDS");
  return told != nullptr ? std::stod(told) : unless_told_s;
}

void expect_ball_on_field(const World& world) {
  const Vec3 ball = world.ball_in_space().position_m;
  const double late_m = 1e-9;
  ASSERT_LT(std::abs(ball.y), field_half_width_m - ball_radius_m + late_m);
  ASSERT_LT(std::abs(ball.x), goal_back_m - ball_radius_m + late_m);
  ASSERT_TRUE(std::abs(ball.x) < field_half_length_m || std::abs(ball.y) < goal_half_width_m);
  ASSERT_GT(ball.z, ball_radius_m - 0.0011);
  ASSERT_LT(ball.z, ball_ceiling_m);
}

// Tilted, it is no square seen from above.
bool stands(const World& world, std::size_t robot) {
  return world.robot_up(robot) > 0.97;
}

void expect_robots_sane(const World& world, const WorldConfig& config) {
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    const Vec2 velocity = world.robot_velocity_m_s(i);
    const Pose pose = world.robot_pose(i);
    // A slow robot is pushed by a fast one.
    ASSERT_LT(std::hypot(velocity.x, velocity.y), 1.2 * robot_spec(Role::forward).max_rim_speed_m_s) << i;
    ASSERT_TRUE(robot_wall_depth_m(pose) < 0.035 || !stands(world, i)) << i;
    for (std::size_t j = i + 1; j < config.robots.size(); ++j) {
      if (stands(world, i) && stands(world, j)) {
        ASSERT_LT(robot_robot_depth_m(pose, world.robot_pose(j)), 0.045) << i << " and " << j;
      }
    }
  }
}

TEST(MatchDriving, NothingIsLostThrownOrInsideAnother) {
  const double each_s = simulated_s(100.0) / 4.0;
  const WorldConfig config = match_world(0.010);
  World world(config);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    RandomDrivers drivers(world, config, seed);
    for (long step = 0; step < std::lround(each_s / config.step_s); ++step) {
      drivers.step();
      ASSERT_NO_FATAL_FAILURE(expect_ball_on_field(world)) << "seed " << seed << " step " << step;
      ASSERT_NO_FATAL_FAILURE(expect_robots_sane(world, config)) << "seed " << seed << " step " << step;
    }
  }
}

TEST(MatchDriving, TheSameCallsGiveTheSameBits) {
  for (const double step_s : {0.001, 0.010}) {
    const WorldConfig config = match_world(step_s);
    World fresh(config);
    World used(config);
    RandomDrivers before(used, config, 9);
    for (int step = 0; step < 300; ++step) {
      before.step();
    }
    RandomDrivers a(fresh, config, 5);
    RandomDrivers b(used, config, 5);
    for (int step = 0; step < 1'000; ++step) {
      a.step();
      b.step();
      ASSERT_EQ(fresh.state_hash(), used.state_hash()) << step;
    }
  }
}

}  // namespace
}  // namespace striker::sil

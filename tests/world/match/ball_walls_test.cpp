// SPDX-License-Identifier: Apache-2.0
// The ball and the walls: it is never inside one, goes into no goal through a post, and its rebound is the
// contact table's whenever in a step it meets the wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "sil/world/ode/ball/flight.hpp"
#include "sil/world/ode/ball/walls.hpp"
#include "sil/world/ode/materials.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

World walled(double step_s) {
  World world({.walls = true, .step_s = step_s});
  world.place_robot(0, {.x_m = -3.0, .y_m = -2.0, .heading_rad = 0.0});
  return world;
}

// Of the ball's surface, in a wall; by the distance to each wall, the post's edge among them.
double ball_depth_m(const Vec2& centre) {
  const double x = std::abs(centre.x);
  const double y = std::abs(centre.y);
  const double corner_m = field_half_length_m + field_half_width_m - corner_leg_m;
  const double behind_m = x - field_half_length_m;
  const double beside_m = y - goal_half_width_m;
  double to_block_m = std::max(-behind_m, -beside_m);
  if (behind_m < 0.0 && beside_m < 0.0) {
    to_block_m = std::hypot(behind_m, beside_m);
  }
  const double nearest_m = std::min(
      {field_half_width_m - y, goal_back_m - x, (corner_m - x - y) / std::numbers::sqrt2, to_block_m});
  return ball_radius_m - nearest_m;
}

double least_gap_m(const Vec3& centre) {
  std::array<WallGap, ball_wall_count> gaps{};
  wall_gaps(centre, gaps);
  return std::ranges::min(gaps, {}, &WallGap::gap_m).gap_m;
}

TEST(BallWalls, NoShotBesideThePostIsAGoal) {
  int shots = 0;
  World world = walled(0.010);
  for (const double speed_m_s : {3.0, 5.0, 8.0, 12.0}) {
    for (int side = 0; side <= 10; ++side) {
      for (int phase = 0; phase < 10; ++phase) {
        const Vec2 from{3.0 + 0.001 * speed_m_s * phase, 0.505 + 0.005 * side};
        world.place_ball({.position_m = from, .velocity_m_s = {speed_m_s, 0.0}});
        for (int step = 0; step < 50; ++step) {
          world.step();
          ASSERT_LT(ball_depth_m(world.ball().position_m), 1e-9)
              << speed_m_s << " m/s from " << from.x << ", " << from.y;
          ASSERT_FALSE(world.ball().position_m.x > field_half_length_m);
        }
        ++shots;
      }
    }
  }
  EXPECT_EQ(shots, 440);
}

TEST(BallWalls, AShotBetweenThePostsIsAGoal) {
  World world = walled(0.010);
  for (const double y_m : {-0.44, 0.0, 0.44}) {
    world.place_ball({.position_m = {3.0, y_m}, .velocity_m_s = {8.0, 0.0}});
    double furthest_m = 0.0;
    for (int step = 0; step < 30; ++step) {
      world.step();
      furthest_m = std::max(furthest_m, world.ball().position_m.x);
    }
    EXPECT_GT(furthest_m, 4.2) << y_m;
  }
}

TEST(BallWalls, NoShotOfUpTo12MetresASecondIsEverInsideAWall) {
  for (const double step_s : {0.001, 0.010}) {
    World world = walled(step_s);
    for (std::uint64_t i = 0; i < 1'000; ++i) {
      Random random(3, i, 0);
      const double direction_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
      const double speed_m_s = random.uniform(0.5, 12.0);
      world.place_ball(
          {.position_m = {random.uniform(-3.8, 3.8), random.uniform(-2.2, 2.2)},
           .velocity_m_s = {speed_m_s * std::cos(direction_rad), speed_m_s * std::sin(direction_rad)}});
      if (ball_depth_m(world.ball().position_m) > 0.0) {
        continue;  // placed into a corner
      }
      for (int step = 0; step < 100; ++step) {
        world.step();
        ASSERT_LT(ball_depth_m(world.ball().position_m), 1e-9) << "ball " << i;
      }
    }
  }
}

struct Rebound {
  double normal;  // speeds after over before, less the damping of the step
  double along;
};

// A shot at the side wall that begins at this share of a step's way in front of a fixed place.
Rebound rebound(double speed_m_s, double angle_rad, double phase) {
  World world = walled(0.010);
  const Vec2 velocity{speed_m_s * std::sin(angle_rad), speed_m_s * std::cos(angle_rad)};
  world.place_ball({.position_m = {-0.010 * phase * velocity.x, 1.2 - 0.010 * phase * velocity.y},
                    .velocity_m_s = velocity});
  Vec2 before = velocity;
  while (world.ball().velocity_m_s.y > 0.0) {
    before = world.ball().velocity_m_s;
    world.step();
  }
  const Vec2 after = world.ball().velocity_m_s;
  return {.normal = -after.y / before.y / kept_in_10_ms, .along = after.x / before.x / kept_in_10_ms};
}

TEST(BallWalls, TheReboundDoesNotDependOnWhenInAStepItHappens) {
  for (const double speed_m_s : {1.0, 3.0, 6.0, 9.0, 12.0}) {
    for (const double angle_rad : {0.1, 0.5, 1.0}) {
      const double along = rebound(speed_m_s, angle_rad, 0.0).along;
      for (int tenth = 0; tenth < 10; ++tenth) {
        const Rebound back = rebound(speed_m_s, angle_rad, 0.1 * tenth);
        EXPECT_NEAR(back.normal, 0.75, 1e-6) << speed_m_s << " m/s, " << angle_rad << " rad, " << tenth;
        EXPECT_NEAR(back.along, along, 1e-6) << speed_m_s << " m/s, " << angle_rad << " rad, " << tenth;
      }
    }
  }
}

// 10 ms steps and 1 ms steps bring a ball to the same place by way of two walls.
TEST(BallWalls, TheStepDoesNotMoveWhereItGoes) {
  for (const Vec2 velocity : {Vec2{5.0, 6.0}, Vec2{-3.0, 4.0}, Vec2{8.0, -2.0}}) {
    World coarse = walled(0.010);
    World fine = walled(0.001);
    for (World* world : {&coarse, &fine}) {
      world->place_ball({.position_m = {0.5, 0.3}, .velocity_m_s = velocity});
      run(*world, 0.8);
    }
    EXPECT_NEAR(coarse.ball().position_m.x, fine.ball().position_m.x, 0.03);
    EXPECT_NEAR(coarse.ball().position_m.y, fine.ball().position_m.y, 0.03);
  }
}

// ODE's own contact of the same table, with the ball just touching the wall.
TEST(BallWalls, TheImpactIsThatOfOdesContact) {
  constexpr double step_s = 0.010;
  const OdeWorld ode(step_s);
  dWorldSetGravity(ode.get(), 0.0, 0.0, 0.0);
  dWorldSetDamping(ode.get(), 0.0, 0.0);
  const Ball ball = make_ball(ode.get(), 1.0, step_s);
  const JointGroupHandle joints(dJointGroupCreate(0));
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(9, i, 0);
    place(ball, {.position_m = {}, .velocity_m_s = {0.0, random.uniform(0.5, 12.0)}});
    dBodySetLinearVel(ball.body, random.uniform(-8.0, 8.0), dBodyGetLinearVel(ball.body)[1], 0.0);
    const Vec3 normal{0.0, -1.0, 0.0};
    const BallMotion expected = after_impact(motion_of(ball), normal, Bounce::table);
    dContact contact{};
    contact.surface = surface(Pair::wall_ball, step_s);
    contact.surface.mode |= dContactFDir1;  // along the slip, where the pyramid is Coulomb's cone
    const Vec3 slip =
        motion_of(ball).velocity_m_s - ball_radius_m * cross(motion_of(ball).spin_rad_s, normal);
    const double across = std::hypot(slip.x, slip.z);
    contact.fdir1[0] = slip.x / across;
    contact.fdir1[2] = slip.z / across;
    contact.geom.normal[1] = normal.y;
    contact.geom.pos[1] = ball_radius_m;
    contact.geom.pos[2] = dBodyGetPosition(ball.body)[2];
    dJointAttach(dJointCreateContact(ode.get(), joints.get(), &contact), ball.body, nullptr);
    dWorldStep(ode.get(), step_s);
    dJointGroupEmpty(joints.get());
    const BallMotion after = motion_of(ball);
    EXPECT_LT(length(after.velocity_m_s - expected.velocity_m_s), 0.02) << i;
    EXPECT_LT(length(after.spin_rad_s - expected.spin_rad_s), 0.5) << i;
  }
}

// The two accounts of the walls that the ball knows: the gap to each, and the first on its way.
TEST(BallWalls, AWayEndsWhereTheGapDoes) {
  int hits = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(5, i, 0);
    const Vec3 from{random.uniform(-4.3, 4.3), random.uniform(-2.27, 2.27), random.uniform(0.05, 0.75)};
    if (least_gap_m(from) < 0.0) {
      continue;
    }
    const Vec3 way{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.1, 0.1)};
    const auto hit = first_wall_hit(from, way);
    const Vec3 end = from + (hit ? hit->share : 1.0) * way;
    ASSERT_GT(least_gap_m(end), -1e-12) << i;
    if (hit) {
      ++hits;
      ASSERT_LT(least_gap_m(end), 1e-12) << i;
      ASSERT_LT(least_gap_m(end + 1e-6 * way), 0.0) << i;
    }
  }
  EXPECT_GT(hits, 1'000);
}

TEST(BallWalls, TheCeilingTurnsTheBallDown) {
  const auto hit = first_wall_hit({0.0, 0.0, 0.7}, {0.0, 0.0, 0.1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->share, (ball_ceiling_m - ball_radius_m - 0.7) / 0.1, 1e-9);
  EXPECT_EQ(hit->normal, (Vec3{0.0, 0.0, -1.0}));
}

TEST(BallWalls, ADroppedBallNeverGoesBelowTheFloor) {
  World world = walled(0.010);
  for (const double height_m : {0.1, 0.3, 0.7}) {
    world.drop_ball({0.3, 0.2}, height_m);
    for (int step = 0; step < 100; ++step) {
      world.step();
      ASSERT_GT(world.ball_in_space().position_m.z, ball_radius_m - 0.0011) << height_m;
    }
    EXPECT_NEAR(world.ball_in_space().position_m.z, ball_radius_m, 1e-4);
  }
}

}  // namespace
}  // namespace striker::sil

// SPDX-License-Identifier: Apache-2.0
// What an episode starts with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sil/world/field_specs.hpp"
#include "tests/world/play.hpp"

namespace striker::sil {
namespace {

constexpr std::uint64_t draws = 10'000;

// In the robot's frame.
BallState seen_from(const Pose& robot, const BallState& ball) {
  const double c = std::cos(robot.heading_rad);
  const double s = std::sin(robot.heading_rad);
  const double x = ball.position_m.x - robot.x_m;
  const double y = ball.position_m.y - robot.y_m;
  const Vec2 v = ball.velocity_m_s;
  return {.position_m = {c * x + s * y, c * y - s * x},
          .velocity_m_s = {c * v.x + s * v.y, c * v.y - s * v.x}};
}

TEST(KickDraw, StaysInItsRangesAndFillsThem) {
  double slowest_m_s = 10.0;
  double fastest_m_s = 0.0;
  double widest_miss_m = 0.0;
  int misses_inside_half_the_area = 0;
  double bearing_x = 0.0;
  double bearing_y = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const KickStart start = draw_kick(3, i, PoseMode::origin);
    ASSERT_EQ(start.robot.x_m, 0.0);
    ASSERT_EQ(start.robot.y_m, 0.0);
    ASSERT_EQ(start.robot.heading_rad, 0.0);
    const Vec2 p = start.ball.position_m;
    const Vec2 v = start.ball.velocity_m_s;
    const double speed_m_s = std::hypot(v.x, v.y);
    ASSERT_NEAR(std::hypot(p.x, p.y), 2.0, 1e-12);
    // The line of movement passes the centre at this distance, which is at most that of the point aimed at.
    const double miss_m = std::abs(p.x * v.y - p.y * v.x) / speed_m_s;
    ASSERT_LE(miss_m, 0.5 + 1e-12);
    ASSERT_LT(p.x * v.x + p.y * v.y, 0.0);
    slowest_m_s = std::min(slowest_m_s, speed_m_s);
    fastest_m_s = std::max(fastest_m_s, speed_m_s);
    widest_miss_m = std::max(widest_miss_m, miss_m);
    misses_inside_half_the_area += miss_m < 0.25 ? 1 : 0;
    bearing_x += p.x / 2.0;
    bearing_y += p.y / 2.0;
  }
  EXPECT_GE(slowest_m_s, 1.0);
  EXPECT_LT(slowest_m_s, 1.01);
  EXPECT_LE(fastest_m_s, 3.0);
  EXPECT_GT(fastest_m_s, 2.99);
  EXPECT_GT(widest_miss_m, 0.48);
  // Uniform in the disc, seen along a line: |miss| < r/2 has the share 1/3 + sqrt(3)/(2 pi) = 0.609.
  EXPECT_NEAR(misses_inside_half_the_area / static_cast<double>(draws), 0.609, 0.02);
  EXPECT_NEAR(bearing_x / draws, 0.0, 0.03);
  EXPECT_NEAR(bearing_y / draws, 0.0, 0.03);
}

TEST(KickDraw, TheBallIsTheSameFromEveryPose) {
  double widest_x_m = 0.0;
  double widest_y_m = 0.0;
  double widest_heading_rad = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const BallState origin = draw_kick(3, i, PoseMode::origin).ball;
    const KickStart anywhere = draw_kick(3, i, PoseMode::anywhere);
    const BallState ball = seen_from(anywhere.robot, anywhere.ball);
    ASSERT_NEAR(ball.position_m.x, origin.position_m.x, 1e-12);
    ASSERT_NEAR(ball.position_m.y, origin.position_m.y, 1e-12);
    ASSERT_NEAR(ball.velocity_m_s.x, origin.velocity_m_s.x, 1e-12);
    ASSERT_NEAR(ball.velocity_m_s.y, origin.velocity_m_s.y, 1e-12);
    widest_x_m = std::max(widest_x_m, std::abs(anywhere.robot.x_m));
    widest_y_m = std::max(widest_y_m, std::abs(anywhere.robot.y_m));
    widest_heading_rad = std::max(widest_heading_rad, std::abs(anywhere.robot.heading_rad));
  }
  EXPECT_LE(widest_x_m, field_half_length_m);
  EXPECT_LE(widest_y_m, field_half_width_m);
  EXPECT_LE(widest_heading_rad, std::numbers::pi);
  EXPECT_GT(widest_x_m, 0.99 * field_half_length_m);
  EXPECT_GT(widest_y_m, 0.99 * field_half_width_m);
  EXPECT_GT(widest_heading_rad, 0.99 * std::numbers::pi);
}

// Correlations of independent draws: five standard deviations.
TEST(KickDraw, ThePoseTellsNothingOfTheBall) {
  double x_bearing = 0.0;
  double heading_bearing = 0.0;
  double x_speed = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const Pose robot = draw_kick(3, i, PoseMode::anywhere).robot;
    const BallState ball = draw_kick(3, i, PoseMode::origin).ball;
    const double bearing_rad = std::atan2(ball.position_m.y, ball.position_m.x);
    const double speed_m_s = std::hypot(ball.velocity_m_s.x, ball.velocity_m_s.y);
    x_bearing += robot.x_m / 3.9 * bearing_rad / std::numbers::pi / draws;
    heading_bearing += robot.heading_rad * bearing_rad / std::numbers::pi / std::numbers::pi / draws;
    x_speed += robot.x_m / 3.9 * (speed_m_s - 2.0) / draws;
  }
  const double bound = 5.0 / 3.0 / std::sqrt(static_cast<double>(draws));
  EXPECT_NEAR(x_bearing, 0.0, bound);
  EXPECT_NEAR(heading_bearing, 0.0, bound);
  EXPECT_NEAR(x_speed, 0.0, bound);
}

TEST(KickDraw, SeedsAndEpisodesDiffer) {
  const Vec2 ball = draw_kick(1, 1, PoseMode::origin).ball.position_m;
  EXPECT_NE(ball.x, draw_kick(1, 2, PoseMode::origin).ball.position_m.x);
  EXPECT_NE(ball.x, draw_kick(2, 1, PoseMode::origin).ball.position_m.x);
  EXPECT_EQ(ball.x, draw_kick(1, 1, PoseMode::origin).ball.position_m.x);
}

TEST(KickDraw, TheBallBeforeTheStartRollsToTheStart) {
  World world(kick_world(0.001));
  for (std::uint64_t i = 0; i < 20; ++i) {
    const KickStart start = draw_kick(4, i, PoseMode::anywhere);
    world.place_robot(0, {.x_m = 20.0, .y_m = 20.0, .heading_rad = 0.0});
    world.place_ball(ball_before(start, 0.100));
    run(world, 0.100);
    EXPECT_NEAR(world.ball().position_m.x, start.ball.position_m.x, 1e-4);
    EXPECT_NEAR(world.ball().position_m.y, start.ball.position_m.y, 1e-4);
    EXPECT_NEAR(world.ball().velocity_m_s.x, start.ball.velocity_m_s.x, 1e-4);
    EXPECT_NEAR(world.ball().velocity_m_s.y, start.ball.velocity_m_s.y, 1e-4);
  }
}

}  // namespace
}  // namespace striker::sil

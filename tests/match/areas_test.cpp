// SPDX-License-Identifier: Apache-2.0
// Borders, to the side that the published referee has them on.
#include "sil/match/referee/areas.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sil/match/referee/free_spot.hpp"

namespace striker::sil {
namespace {

TEST(Areas, LinesAreWhereTheFieldHasThem) {
  EXPECT_EQ(penalty_line_m, 3.0);
  EXPECT_EQ(goal_area_line_m, 3.5);
}

TEST(Areas, AGoalIsBehindTheLineAndBetweenThePosts) {
  for (const double end : {-1.0, 1.0}) {
    EXPECT_TRUE(in_a_goal({end * 3.91, 0.49}));
    EXPECT_TRUE(in_a_goal({end * 4.3, -0.49}));
    EXPECT_FALSE(in_a_goal({end * 3.9, 0.0}));
    EXPECT_FALSE(in_a_goal({end * 3.91, 0.5}));
    EXPECT_FALSE(in_a_goal({end * 3.91, -0.51}));
  }
}

TEST(Areas, OutIsBeyondTheWalls) {
  EXPECT_FALSE(is_out({3.925, 1.0}));
  EXPECT_TRUE(is_out({3.926, 1.0}));
  EXPECT_FALSE(is_out({3.93, 0.525}));
  EXPECT_TRUE(is_out({-3.93, -0.526}));
  EXPECT_FALSE(is_out({0.0, 2.349}));
  EXPECT_TRUE(is_out({0.0, -2.351}));
  EXPECT_FALSE(is_out({3.85, 2.299}));
  EXPECT_TRUE(is_out({3.85, 2.301}));
  EXPECT_TRUE(is_out({-3.9, 2.26}));
  EXPECT_FALSE(is_out({-3.9, -2.24}));
}

TEST(Areas, ARobotMayBeInAGoalButNotBehindIt) {
  EXPECT_FALSE(has_left_field({4.35, 0.49}));
  EXPECT_TRUE(has_left_field({4.36, 0.49}));
  EXPECT_TRUE(has_left_field({-3.91, 0.5}));
  EXPECT_FALSE(has_left_field({-3.9, 0.5}));
  EXPECT_FALSE(has_left_field({0.0, 9.0}));  // the side walls do that
}

TEST(Areas, ThePenaltyStripGoesOnBehindTheLine) {
  EXPECT_TRUE(in_own_penalty_strip({-3.001, 0.899}));
  EXPECT_TRUE(in_own_penalty_strip({-4.2, -0.3}));
  EXPECT_FALSE(in_own_penalty_strip({-3.0, 0.0}));
  EXPECT_FALSE(in_own_penalty_strip({-3.5, 0.9}));
  EXPECT_FALSE(in_own_penalty_strip({3.5, 0.0}));
  EXPECT_TRUE(ball_in_a_penalty_area({3.0, 0.9}));
  EXPECT_FALSE(ball_in_a_penalty_area({2.999, 0.0}));
  EXPECT_FALSE(ball_in_a_penalty_area({-3.5, 0.901}));
}

TEST(Areas, ACornerIsBesideThePenaltyArea) {
  EXPECT_TRUE(in_own_corner({-3.1, 0.91}, 1.5));
  EXPECT_FALSE(in_own_corner({-3.1, -0.91}, 1.5));
  EXPECT_TRUE(in_own_corner({-3.1, -0.91}, -1.5));
  EXPECT_FALSE(in_own_corner({-3.1, 0.9}, 1.5));
  EXPECT_FALSE(in_own_corner({-3.0, 1.0}, 1.5));
}

TEST(Areas, TheGoalAreaNarrowsToTheGoal) {
  EXPECT_TRUE(in_opponents_goal_area({3.501, 0.649}));
  EXPECT_TRUE(in_opponents_goal_area({3.9, 0.649}));
  EXPECT_FALSE(in_opponents_goal_area({3.901, 0.649}));
  EXPECT_TRUE(in_opponents_goal_area({3.901, -0.499}));
  EXPECT_FALSE(in_opponents_goal_area({3.5, 0.0}));
  EXPECT_FALSE(in_opponents_goal_area({-3.6, 0.0}));
}

TEST(Areas, AGoalkeeperIsHomeInItsPenaltyAreaAndItsGoal) {
  EXPECT_TRUE(keeper_is_home({-3.001, 0.899}));
  EXPECT_TRUE(keeper_is_home({-3.9, 0.899}));
  EXPECT_FALSE(keeper_is_home({-3.901, 0.5}));
  EXPECT_TRUE(keeper_is_home({-4.2, 0.499}));
  EXPECT_FALSE(keeper_is_home({-3.0, 0.0}));
}

TEST(Areas, ABallLeavesWhereItsWayMeetsTheEdge) {
  EXPECT_EQ(exit_point({3.8, 0.2}, {4.0, 0.4}), (Vec2{3.9, 0.2 + 0.5 * 0.2}));
  EXPECT_NEAR(exit_point({0.0, 2.3}, {0.2, 2.35}).x, 0.1, 1e-12);
  EXPECT_EQ(exit_point({0.0, 2.3}, {0.2, 2.35}).y, 2.325);
  // Over the side line first, then beyond the end line.
  EXPECT_EQ(exit_point({3.7, 2.3}, {4.0, 2.6}).y, 2.325);
  EXPECT_NEAR(exit_point({3.7, 2.3}, {4.0, 2.6}).x, 3.725, 1e-12);
  EXPECT_EQ(exit_point({3.91, 1.0}, {3.95, 1.2}), (Vec2{3.9, 1.2}));
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exit_point({0.0, 0.0}, {far, 0.3}), (Vec2{3.9, 0.3}));
}

TEST(FreeSpot, IsTheWantedOneIfNobodyIsThere) {
  const std::array<Vec2, 2> others = {Vec2{-1.5, 1.226}, Vec2{3.0, 0.0}};
  EXPECT_EQ(free_spot({-1.5, 1.0}, others, 0.225, ball_reach_m), (Vec2{-1.5, 1.0}));
}

TEST(FreeSpot, IsTheNearestAlongXFirst) {
  const std::array<Vec2, 2> others = {Vec2{-1.5, 1.0}, Vec2{-1.1, 1.0}};
  const auto spot = free_spot({-1.5, 1.0}, others, 0.225, ball_reach_m);
  ASSERT_TRUE(spot);
  EXPECT_NEAR(spot->x, -1.1 + 0.23, 1e-9);  // between the two is no room
  EXPECT_EQ(spot->y, 1.0);
}

TEST(FreeSpot, GoesAlongYWhereTheWallEndsX) {
  const std::array<Vec2, 1> others = {Vec2{3.7, 0.0}};
  const auto spot = free_spot({3.7, 0.0}, others, 0.225, robot_reach_m);
  ASSERT_TRUE(spot);
  EXPECT_EQ(spot->x, 3.7);
  EXPECT_NEAR(spot->y, 0.23, 1e-9);
}

TEST(FreeSpot, IsNoneWhereBothWaysAreTaken) {
  const std::array<Vec2, 1> others = {Vec2{3.7, 2.1}};
  EXPECT_EQ(free_spot({3.7, 2.1}, others, 0.225, robot_reach_m), std::nullopt);
  EXPECT_EQ(free_spot({-4.05, -0.85}, {}, 0.225, robot_reach_m), std::nullopt);  // in a wall
}

TEST(FreeSpot, IsClearOfWallsAndCornerCuts) {
  EXPECT_TRUE(is_clear_of_walls({3.85, 2.2}, ball_reach_m));
  EXPECT_FALSE(is_clear_of_walls({3.851, 0.0}, ball_reach_m));
  EXPECT_FALSE(is_clear_of_walls({0.0, -2.276}, ball_reach_m));
  EXPECT_FALSE(is_clear_of_walls({-3.84, 2.27}, ball_reach_m));  // clear of both walls, not of the cut
  EXPECT_FALSE(is_clear_of_walls({3.8, 0.0}, robot_reach_m));
}

}  // namespace
}  // namespace striker::sil
